#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "engine/alembic/alembic.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/json/close_names.h"
#include "engine/load/format_rows.h"

namespace aleph {

namespace {

bool serves(const SceneFormat& format, FormatUse use) {
    if (use == FormatUse::save) return format.save != nullptr;
    return format.append != nullptr || (use == FormatUse::load && format.load != nullptr);
}

}  // namespace

SceneFormat alembic_format() {
    SceneFormat format;
    format.endings = {".abc"};
    format.description = "an Alembic archive";
    format.append = [](const AppendRequest& request, Scene& scene) {
        return append_alembic(request.path, scene, request.parent_node, request.include);
    };
    return format;
}

const SceneFormats& scene_formats() {
    static const SceneFormats formats = {scene_file_format(), gltf_format(), glb_format(), alembic_format()};
    return formats;
}

const SceneFormat* find_format(const SceneFormats& formats, const std::filesystem::path& path) {
    const std::string ending = lower_extension(path);
    for (const SceneFormat& format : formats) {
        if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end()) return &format;
    }
    return nullptr;
}

std::string list_endings(const SceneFormats& formats, FormatUse use) {
    std::vector<std::string> endings;
    for (const SceneFormat& format : formats) {
        if (serves(format, use)) endings.insert(endings.end(), format.endings.begin(), format.endings.end());
    }
    return endings.empty() ? "" : join_choices(endings);
}

const SceneFormat& require_format(const SceneFormats& formats, FormatUse use, const std::filesystem::path& path,
                                  const std::string& file, const std::string& place) {
    const SceneFormat* format = find_format(formats, path);
    if (format != nullptr && serves(*format, use)) return *format;
    const std::string known = list_endings(formats, use);
    if (use == FormatUse::save) {
        throw InputError(file, place, fmt::format("the name of a scene file must end in {}", known));
    }
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw InputError(file, place, fmt::format("this is a folder; expected a {} file", known));
    throw InputError(file, place,
                     fmt::format("files of the kind \"{}\" are not read; expected a {} file",
                                 printable(lower_extension(path)), known));
}

void check_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place) {
    namespace fs = std::filesystem;
    note_read_file(path);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        throw InputError(file, place, fmt::format("there is no file {}", printable(path.string(), 300)));
    if (!fs::is_regular_file(status)) {
        throw InputError(file, place, fmt::format("{} is not a regular file", printable(path.string(), 300)));
    }
}

std::vector<MissingFile> list_missing_files(const std::filesystem::path& path, const LoadLimits& limits,
                                            const SceneFormats& formats) {
    std::vector<MissingFile> missing;
    const SceneFormat* format = find_format(formats, path);
    if (format == nullptr || format->list_missing == nullptr) return missing;
    try {
        format->list_missing({path, path.string(), limits, formats}, missing);
    } catch (const InputError&) {  // loading says what is wrong with the file
    }
    return missing;
}

}  // namespace aleph
