#include "render/cli/support/output_conflicts.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

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

[[noreturn]] void refuse(const OutputFile& output, const std::string& reason) {
    throw InputError("", output.option,
                     fmt::format("'{}' {}; give another name", printable(output.path.string(), 400), reason));
}

}  // namespace

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
        if (number && read.contains(*number)) refuse(output, "is read by this command and would be replaced");
        const auto [other, is_new] = written.emplace(path, &output);
        if (is_new) continue;
        refuse(output, fmt::format("is written twice by this command, for {} too", other->second->option));
    }
}

}  // namespace aleph
