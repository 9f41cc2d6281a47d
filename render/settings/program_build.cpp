#include "render/settings/program_build.h"

#include <dlfcn.h>
#include <link.h>

#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

/// The file that holds this code: a program, or the Python module.
std::string find_code() {
    Dl_info info;
    link_map* map = nullptr;
    const auto* const here = reinterpret_cast<const void*>(&program_build);
    const bool found = dladdr1(here, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
    return found && map != nullptr && map->l_name[0] != '\0' ? map->l_name : "/proc/self/exe";
}

}  // namespace

const std::string& program_build() {
    static const std::string build = [] {
        const Bytes bytes = read_regular_file(find_code(), "this program", "");
        return std::string(ALEPH_VERSION " ") + hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }();
    return build;
}

}  // namespace aleph
