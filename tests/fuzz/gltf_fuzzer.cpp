// Any bytes as a .glb or .gltf.

#include <string_view>

#include "engine/gltf/gltf.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const bool binary = std::string_view(reinterpret_cast<const char*>(data), size).starts_with("glTF");
    return aleph::read_fuzz_file(binary ? "input.glb" : "input.gltf", data, size,
                                 [](const auto& path, aleph::Scene& scene, int node, int include) {
                                     aleph::append_gltf(path, scene, node, include);
                                 });
}
