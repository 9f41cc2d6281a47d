#include "render/settings/program_build.h"

#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

const std::string& program_build() {
    static const std::string build = [] {
        const Bytes bytes = read_regular_file(code_file(), "this program", "");
        return std::string(ALEPH_VERSION " ") + hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }();
    return build;
}

}  // namespace aleph
