#pragma once
// A study as data, pictures of some frames in several variants, which references judge; study files: JSON, checked with
// scenes/studies/study.schema.json.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Reference that variants are judged by.
struct StudyReference {
    /// "path": traced paths. "settings": the study's settings with `settings` in their places.
    std::string kind = "path";
    int passes = 4;         ///< renderings with random numbers of their own, of which it is the mean; at least 2
    int spp = 32;           ///< samples per pixel of each pass
    SettingMap settings{};  ///< of the kind "settings"
};

/// Values that a setting takes, one after the other.
struct StudyAxis {
    std::string setting;
    std::vector<SettingValue> values;
};

/// A variant: settings that differ from the study's own, or pictures that another program made.
struct StudyVariant {
    std::string name;
    SettingMap settings;  ///< or noise that is added to the reference (reference_picture.h)
    std::map<std::int64_t, std::filesystem::path> pictures{};  ///< files by frame; empty: rendered
    bool forbids_more = false;                                 ///< beside what a scene forbids, not in its place
};

/// For whom errors are visible: a model of vision with its viewing conditions. As it stands: as settings have it.
struct StudyViewer {
    std::string name = "own";
    SettingMap settings;  ///< vision, bands, grid, viewing.persistence, ...
};

/// Maps of visible differences by another program: for each picture of a run a file of the same name in a folder or,
/// for a study of one variant, files by frame.
struct StudyJudge {
    std::string name;
    std::filesystem::path folder;                            ///< also of the files, for messages
    std::map<std::int64_t, std::filesystem::path> frames{};  ///< empty: files have the pictures' names
};

/// Frames of one scene.
struct StudyScene {
    std::filesystem::path file;
    std::string frames;  ///< "20,60" (frame_list.h); empty: the middle of the shot
};

/// A search of the fixed settings that cost least for what a viewer sees (search_study.h).
struct StudySearch {
    std::vector<StudyAxis> settings;  ///< that candidates differ in, with the values that they may take
    int candidates = 48;              ///< of the first round, for each scene
    int rounds = 3;                   ///< the last is as the study asks
};

/// Renderings of each variant.
struct StudyRuns {
    int repeats = 1;                         ///< with equal random numbers, for the uncertainty of times
    std::vector<std::uint32_t> seeds = {0};  ///< with different ones, for that of errors
};

struct Study {
    std::string title, description;
    std::vector<StudyScene> scenes;  ///< at least one
    SettingMap settings;             ///< of every variant and of the reference, over those of the scene
    StudyReference reference;
    std::vector<StudyAxis> sweep;        ///< every combination is a variant
    std::vector<StudyVariant> variants;  ///< and these are
    bool effects = false;                ///< adds a ledger of effects (effects_ledger.h)
    std::optional<StudySearch> search;   ///< adds the best fixed settings
    std::vector<std::string> metrics;    ///< metric_table.h; empty: the usual ones
    std::vector<StudyViewer> viewers;    ///< at least one; the first judges where one threshold is meant
    StudyRuns runs;
    std::string file = "study";  ///< for messages
};

/// Every combination of the axes' values; the last axis changes fastest.
/// @throws InputError for more than 10,000
std::vector<SettingMap> list_combinations(const std::vector<StudyAxis>& axes);

/// The variants of the sweep, each named by its settings ("error=1,guide=none"), then the named ones.
/// @throws InputError for more than 10,000, two variants of one name, or none at all unless there is a search
std::vector<StudyVariant> list_variants(const Study& study);

/// "error=1,guide=none"
std::string name_settings(const SettingMap& settings, const std::vector<StudyAxis>& order = {});

/// Returns whether a file is a study, and no scene: a .json file whose root has a list `scenes`.
/// @throws InputError if it is a .json file that cannot be read
bool is_study(const std::filesystem::path& file);

/// A study file. Paths of scenes are taken from its folder. Comments are allowed.
/// @throws InputError with the JSON pointer of what is wrong; settings are checked when the study runs
Study load_study(const std::filesystem::path& file);

/// The text of a study file.
/// @param file  for messages and for relative paths
/// @throws InputError
Study parse_study(std::string_view text, const std::filesystem::path& file);

}  // namespace aleph
