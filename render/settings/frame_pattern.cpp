#include "render/settings/frame_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/base/files.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

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

/// The part of the name in the number's place, if the rest of the name fits.
std::optional<std::string_view> text_of_number(std::string_view name, const std::string& pattern,
                                               const NumberField& field) {
    const std::string_view before = std::string_view(pattern).substr(0, field.begin);
    const std::string_view after = std::string_view(pattern).substr(field.begin + field.length);
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) {
        return std::nullopt;
    }
    return name.substr(before.size(), name.size() - before.size() - after.size());
}

[[noreturn]] void refuse(const std::string& option, const std::string& pattern, const std::string& reason) {
    throw InputError("", option, fmt::format("'{}': {}", printable(pattern, 400), reason));
}

bool is_picture(const fs::path& path) {
    constexpr const char* known[] = {".exr", ".png", ".jpg", ".jpeg", ".hdr"};
    return std::ranges::find(known, lower_extension(path)) != std::end(known);
}

struct NumberedName {
    std::int64_t frame;
    std::string rest;  ///< the name with # in the number's place
};

/// Nothing if the name has no number before its extension, or one beyond 32 bits.
std::optional<NumberedName> split_name(const fs::path& path) {
    const std::string stem = path.stem().string();
    const std::size_t last = stem.find_last_of("0123456789");
    if (last == std::string::npos) return std::nullopt;
    const std::size_t before = stem.find_last_not_of("0123456789", last);
    std::size_t first = before == std::string::npos ? 0 : before + 1;
    if (first > 0 && stem[first - 1] == '-' && (first == 1 || stem[first - 2] == '.' || stem[first - 2] == '_')) {
        --first;
    }
    std::int32_t frame = 0;
    const auto [end, failure] = std::from_chars(stem.data() + first, stem.data() + last + 1, frame);
    if (failure != std::errc() || end != stem.data() + last + 1) return std::nullopt;
    return NumberedName{frame, stem.substr(0, first) + "#" + stem.substr(last + 1) + path.extension().string()};
}

}  // namespace

std::optional<NumberField> find_number_field(const std::string& name, const std::string& option) {
    std::optional<NumberField> found;
    for (std::size_t at = name.find_first_of("#%"); at != std::string::npos; at = name.find_first_of("#%", at)) {
        const auto field = field_at(name, at);
        if (!field) refuse(option, name, "after '%' comes 'd' or '04d'");
        if (found) refuse(option, name, "the frame number has more than one place");
        found = field;
        at += field->length;
    }
    return found;
}

std::string insert_number(const std::string& name, const NumberField& field, int frame) {
    std::string text = name;
    return text.replace(field.begin, field.length, fmt::format("{:0{}}", frame, field.width));
}

FrameFiles find_frame_files(const std::string& pattern, const std::string& option) {
    const fs::path path(pattern);
    const std::string name = path.filename().string();
    std::error_code error;
    if (fs::is_directory(path, error))
        refuse(option, pattern, "this is a folder; add its files' names, as in name.####.exr");
    const auto field = find_number_field(name, option);
    if (!field) {
        if (!fs::exists(path, error))
            refuse(option, pattern, "there is no such file; several frames are named as name.####.exr");
        return {{0, path}};
    }
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error)) refuse(option, pattern, "there is no such folder");
    FrameFiles files;
    std::string near;  // a name that differs only in how its number is written
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string file = entry.path().filename().string();
        const auto text = text_of_number(file, name, *field);
        if (!text) continue;
        int frame = 0;
        const auto [end, failure] = std::from_chars(text->data(), text->data() + text->size(), frame);
        if (failure != std::errc() || end != text->data() + text->size()) continue;
        if (insert_number(name, *field, frame) == file) {
            files[frame] = path.has_parent_path() ? folder / file : fs::path(file);
        } else if (near.empty() || file < near) {
            near = file;
        }
    }
    if (error) refuse(option, pattern, error.message());
    if (files.empty()) {
        refuse(option, pattern,
               near.empty() ? "no file fits; each # stands for a digit of the frame number"
                            : fmt::format("no file fits, but {} would with another number of #", printable(near)));
    }
    return files;
}

FrameFiles find_folder_frames(const std::string& folder, const std::string& option) {
    FrameFiles files;
    std::string sequence;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const auto name = is_picture(entry.path()) ? split_name(entry.path().filename()) : std::nullopt;
        if (!name) continue;
        if (sequence.empty()) sequence = name->rest;
        if (name->rest != sequence) {
            refuse(option, folder,
                   fmt::format("holds several sequences, such as {} and {}; name one, as in name.####.exr",
                               printable(std::min(sequence, name->rest)), printable(std::max(sequence, name->rest))));
        }
        if (!files.emplace(name->frame, entry.path()).second) {
            refuse(option, folder, fmt::format("holds frame {} twice", name->frame));
        }
    }
    if (error) refuse(option, folder, error.message());
    if (files.empty()) refuse(option, folder, "holds no numbered pictures, such as name.0001.exr");
    return files;
}

}  // namespace aleph
