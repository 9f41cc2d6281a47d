#include "render/cli/support/output_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/settings/frame_pattern.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_pattern(const std::string& pattern, const std::string& reason) {
    throw InputError("", "--output", fmt::format("'{}': {}", printable(pattern, 400), reason));
}

std::optional<OutputFormat> find_format(const fs::path& path) {
    const std::string extension = lower_extension(path);
    constexpr const char* known[] = {".exr", ".png"};  // in the order of OutputFormat
    const auto found = std::ranges::find(known, extension);
    return found == std::end(known) ? std::nullopt : std::optional(static_cast<OutputFormat>(found - known));
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    if (!path.has_filename() || path.filename() == "." || path.filename() == "..") return true;
    if (fs::is_directory(path, ignored)) return true;
    return !path.has_extension() && path.filename().string().find_first_of("#%") == std::string::npos;
}

/// The pattern with its file name.
fs::path full_pattern(const std::string& pattern, const std::string& scene_name) {
    if (pattern == "-") refuse_pattern(pattern, "frames are not written to standard output; name a file or a folder");
    const fs::path path(pattern);
    if (is_folder(path)) return path / (scene_name + ".####.exr");
    find_number_field(path.filename().string(), "--output");  // its reasons come before the extension's
    if (find_format(path)) return path;
    if (names_film(pattern))
        refuse_pattern(pattern, "films are written by `aleph render`, `maps` and `preview`; name .exr or .png files");
    const std::string extension = path.extension().string();
    refuse_pattern(pattern, fmt::format("{}; possible are .exr and .png, or a folder, which ends in '/', and "
                                        "films: .mp4, .mov, .webm and .gif",
                                        extension.find_first_of("#%") == std::string::npos && !extension.empty()
                                            ? fmt::format("the extension {} is not known", printable(extension))
                                            : "the name has no extension"));
}

}  // namespace

bool names_film(const std::string& path) {
    const std::string extension = lower_extension(path);
    return !is_folder(path) &&
           (extension == ".mp4" || extension == ".mov" || extension == ".webm" || extension == ".gif");
}

OutputFormat output_format(const fs::path& path) {
    return find_format(path).value_or(OutputFormat::exr);
}

fs::path output_path(const std::string& pattern, const std::string& scene_name, int frame) {
    const fs::path path = full_pattern(pattern, scene_name);
    std::string name = path.filename().string();
    if (const auto field = find_number_field(name, "--output")) name = insert_number(name, *field, frame);
    return path.parent_path() / name;
}

std::vector<fs::path> output_paths(const std::string& pattern, const std::string& scene_name,
                                   const std::vector<int>& frames) {
    const fs::path path = full_pattern(pattern, scene_name);
    if (!find_number_field(path.filename().string(), "--output") && frames.size() > 1) {
        refuse_pattern(pattern, fmt::format("{} frames need a number in the name, as in name.####.exr", frames.size()));
    }
    std::vector<fs::path> paths;
    for (const int frame : frames) paths.push_back(output_path(pattern, scene_name, frame));
    return paths;
}

}  // namespace aleph
