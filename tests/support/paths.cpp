#include "tests/support/paths.h"

namespace aleph {

std::filesystem::path source_folder() {
    return ALEPH_SOURCE_DIR;
}

std::filesystem::path own_assets_folder() {
    return source_folder() / "tests" / "assets";
}

std::filesystem::path assets_folder() {
    return source_folder().parent_path() / "shared" / "assets";
}

std::string missing_asset(const std::filesystem::path& file) {
    return "files of other programs are not here: " + file.string();
}

std::filesystem::path build_folder() {
    return ALEPH_BUILD_DIR;
}

std::string program_path(const std::string& name) {
    return (build_folder() / name).string();
}

}  // namespace aleph
