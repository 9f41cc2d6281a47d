#include "render/cli/output_path.h"

#include <fmt/format.h>

#include <system_error>

#include "engine/base/errors.h"
#include "render/cli/frame_pattern.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

/// The pattern with its file name.
fs::path full_pattern(const std::string& pattern, const std::string& scene_name) {
    const fs::path path(pattern);
    std::error_code ignored;
    const bool folder = !path.has_filename() || path.filename() == "." || path.filename() == ".." ||
                        fs::is_directory(path, ignored) ||
                        (!path.has_extension() && path.filename().string().find_first_of("#%") == std::string::npos);
    return folder ? path / (scene_name + ".####.exr") : path;
}

}  // namespace

fs::path output_path(const std::string& pattern, const std::string& scene_name, int frame) {
    const fs::path path = full_pattern(pattern, scene_name);
    std::string name = path.filename().string();
    if (const auto field = find_number_field(name, "--output")) name = insert_number(name, *field, frame);
    return path.parent_path() / name;
}

void prepare_output(const std::string& pattern, const std::string& scene_name, std::size_t frame_count) {
    const fs::path path = full_pattern(pattern, scene_name);
    if (!find_number_field(path.filename().string(), "--output") && frame_count > 1) {
        throw InputError("", "--output",
                         fmt::format("'{}': {} frames need a number in the name, as in name.####.exr",
                                     printable(pattern), frame_count));
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    if (fs::is_directory(folder, error)) return;
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    if (!fs::is_directory(parent, error)) {
        throw OutputError(printable(path.string(), 4096),
                          fmt::format("the folder '{}' does not exist", printable(parent.string(), 4096)));
    }
    fs::create_directory(folder, error);
    if (error) {
        throw OutputError(printable(folder.string(), 4096),
                          fmt::format("cannot create this folder: {}", error.message()));
    }
}

}  // namespace aleph
