// Any bytes as the text of a scene file: an InputError, or a scene that can be posed and that says the same when it is
// written and read again.

#include <cstdint>
#include <cstdlib>

#include "engine/base/errors.h"
#include "engine/pose/pose.h"
#include "engine/scene_file/scene_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    aleph::SceneText read;
    try {
        read = aleph::read_scene_text({reinterpret_cast<const char*>(data), size}, "input.json");
    } catch (const aleph::InputError&) {
        return 0;
    }
    aleph::pose(read.scene, 0.3);
    std::string text;
    try {
        text = aleph::write_scene_text(read.scene, "again.json");
    } catch (const aleph::InputError&) {  // what the format cannot say is refused by name
        return 0;
    }
    if (aleph::read_scene_text(text, "again.json").scene != read.scene) std::abort();
    return 0;
}
