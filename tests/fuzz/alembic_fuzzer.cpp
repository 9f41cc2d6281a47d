// Any bytes as an Alembic archive: an InputError or a scene that can be posed.

#include "engine/alembic/alembic.h"
#include "engine/base/errors.h"
#include "engine/pose/pose.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto path = aleph::write_fuzz_file("input.abc", data, size);
    aleph::Scene scene;
    scene.source.includes.push_back({path.filename().string(), aleph::no_index});
    try {
        aleph::append_alembic(path, scene, aleph::no_index, 0);
        aleph::pose(scene, 0.3);
    } catch (const aleph::InputError&) {
    }
    return 0;
}
