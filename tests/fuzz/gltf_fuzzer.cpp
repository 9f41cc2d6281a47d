// Any bytes as a .glb or .gltf: an InputError or a scene that can be posed.

#include "engine/base/errors.h"
#include "engine/gltf/gltf.h"
#include "engine/pose/pose.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool binary = size >= 4 && data[0] == 'g' && data[1] == 'l' && data[2] == 'T' && data[3] == 'F';
    const auto path = aleph::write_fuzz_file(binary ? "input.glb" : "input.gltf", data, size);
    aleph::Scene scene;
    scene.source.includes.push_back({path.filename().string(), aleph::no_index});
    try {
        aleph::append_gltf(path, scene, aleph::no_index, 0);
        aleph::pose(scene, 0.3);
    } catch (const aleph::InputError&) {
    }
    return 0;
}
