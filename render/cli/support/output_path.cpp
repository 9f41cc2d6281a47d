#include "render/cli/support/output_path.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/settings/frame_pattern.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

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

using FileNumber = std::pair<dev_t, ino_t>;

/// The identity that hard links have in common; nothing if there is no such file.
std::optional<FileNumber> file_number(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return FileNumber(status.st_dev, status.st_ino);
}

/// The path that is written: links are followed, and so is ".." behind a folder that is yet to be made.
fs::path written_path(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::absolute(follow_links(path), error);
    const fs::path plain = fs::weakly_canonical(whole, error);
    return error ? whole.lexically_normal() : plain;
}

[[noreturn]] void refuse_output(const OutputFile& output, const std::string& reason) {
    throw InputError("", output.option,
                     fmt::format("'{}' {}; give another name", printable(output.path.string(), 400), reason));
}

}  // namespace

void refuse_pattern(const std::string& pattern, const std::string& reason) {
    throw InputError("", "--output", fmt::format("'{}': {}", printable(pattern, 400), reason));
}

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

void refuse_overwriting(const std::vector<fs::path>& inputs, const std::vector<OutputFile>& outputs) {
    std::set<FileNumber> read;
    for (const fs::path& input : inputs) {
        if (const auto number = file_number(input)) read.insert(*number);
    }
    std::map<fs::path, const OutputFile*> written;
    for (const OutputFile& output : outputs) {
        if (output.path.empty()) continue;
        const fs::path path = written_path(output.path);
        const auto number = file_number(path);
        if (number && read.contains(*number)) refuse_output(output, "is read by this command and would be replaced");
        const auto [other, is_new] = written.emplace(path, &output);
        if (is_new) continue;
        refuse_output(output, fmt::format("is written twice by this command, for {} too", other->second->option));
    }
}

}  // namespace aleph
