#pragma once
// The kinds of files that scenes are loaded from, saved to and made of: one row of a table each. Loading, includes,
// saving, lists of missing files, help texts and messages read the table and know no file ending themselves.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/append.h"

namespace aleph {

struct SceneFormat;
using SceneFormats = std::vector<SceneFormat>;

/// A file that is loaded by itself.
struct LoadRequest {
    std::filesystem::path path;
    std::string file;  ///< what messages call it
    LoadLimits limits;
    const SceneFormats& formats;  ///< of the files that it may include
};

/// A file whose content is appended to a scene.
struct AppendRequest {
    std::filesystem::path path;
    int parent_node = no_index;  ///< of the file's roots
    int include = 0;             ///< becomes `include` of every element that is appended
    LoadLimits limits;
    const std::vector<std::string>* animations = nullptr;  ///< those that play, by name; null: all
};

/// A file that another one names and that is not there.
struct MissingFile {
    std::string file;   ///< the one that names it
    std::string place;  ///< where, as a JSON pointer
    std::string path;   ///< as it stands there
};

struct SceneFormat {
    std::vector<std::string> endings;  ///< of file names: lower case, with the dot
    std::string description;           ///< with its article, for messages: "a glTF file"

    /// Loads a complete scene. Null: the scene is what `append` appends, with a camera if the file has none.
    /// @throws InputError
    Scene (*load)(const LoadRequest&) = nullptr;
    /// Appends the content to a scene, which stays as it was where an error is thrown; returns the times that the file
    /// states. Null: such files cannot be included. @throws InputError
    FileTiming (*append)(const AppendRequest&, Scene&) = nullptr;
    /// Writes a scene, completely or not at all; returns what the file does not say, a sentence each. Null: such files
    /// are not written. @throws InputError, OutputError
    std::vector<std::string> (*save)(const Scene&, const std::filesystem::path&) = nullptr;
    /// Adds the files that the file names and that are not there. Null: it names none. @throws InputError
    void (*list_missing)(const LoadRequest&, std::vector<MissingFile>&) = nullptr;

    bool has_animation_names = false;  ///< an include may choose animations by their names
};

/// aleph's own scene files, glTF and Alembic.
const SceneFormats& scene_formats();

/// The format that the ending of the file's name stands for, in either case; null for an unknown one.
const SceneFormat* find_format(const SceneFormats& formats, const std::filesystem::path& path);

/// The uses that a file may have.
enum class FormatUse { load, include, save };

/// The format of a file for a use. @param file, place  what the error names
/// @throws InputError that lists the endings of the formats with that use
const SceneFormat& require_format(const SceneFormats& formats, FormatUse use, const std::filesystem::path& path,
                                  const std::string& file, const std::string& place);

/// The endings of the formats with a use, for help texts: ".json, .gltf, .glb or .abc".
std::string list_endings(const SceneFormats& formats, FormatUse use);

/// Files that a file or its includes name and that are not there, all of them: loading stops at the first. Those that
/// cannot be read are left out; loading says why.
/// @param limits  those of the loading that failed: a file that is refused for its size is not parsed here either
std::vector<MissingFile> list_missing_files(const std::filesystem::path& path, const LoadLimits& limits = {},
                                            const SceneFormats& formats = scene_formats());

}  // namespace aleph
