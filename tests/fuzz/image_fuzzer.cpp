// Any bytes as a texture: an InputError or a picture.

#include <cstdint>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        aleph::decode_texture({data, data + size}, "input");
    } catch (const aleph::InputError&) {
    }
    return 0;
}
