#include "render/cli/output_path.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <system_error>

#include "engine/base/errors.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

/// The place of the frame number in a file name.
struct NumberField {
    std::size_t begin, length;
    int width;
};

/// A field that starts at `at`: a run of '#', %d or %0Nd.
std::optional<NumberField> field_at(const std::string& name, std::size_t at) {
    if (name[at] == '#') {
        const std::size_t end = std::min(name.find_first_not_of('#', at), name.size());
        return NumberField{at, end - at, static_cast<int>(end - at)};
    }
    if (name.compare(at, 2, "%d") == 0) return NumberField{at, 2, 1};
    if (name.size() >= at + 4 && name[at + 1] == '0' && name[at + 2] >= '1' && name[at + 2] <= '9' &&
        name[at + 3] == 'd') {
        return NumberField{at, 4, name[at + 2] - '0'};
    }
    return std::nullopt;
}

std::optional<NumberField> find_field(const std::string& name) {
    std::optional<NumberField> found;
    for (std::size_t at = name.find_first_of("#%"); at != std::string::npos; at = name.find_first_of("#%", at)) {
        const auto field = field_at(name, at);
        if (!field) {
            throw InputError("", "--output", fmt::format("'{}': after '%' comes 'd' or '04d'", printable(name)));
        }
        if (found) {
            throw InputError("", "--output",
                             fmt::format("'{}': the frame number has more than one place", printable(name)));
        }
        found = field;
        at += field->length;
    }
    return found;
}

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
    if (const auto field = find_field(name)) {
        name.replace(field->begin, field->length, fmt::format("{:0{}}", frame, field->width));
    }
    return path.parent_path() / name;
}

void prepare_output(const std::string& pattern, const std::string& scene_name, std::size_t frame_count) {
    const fs::path path = full_pattern(pattern, scene_name);
    if (!find_field(path.filename().string()) && frame_count > 1) {
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
