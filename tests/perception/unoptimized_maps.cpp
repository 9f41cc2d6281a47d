// Writes all_maps() of a build without optimization to the standard output, as bytes.

#include <cstdio>

#include "tests/support/scenes/perception_scene.h"

int main() {
    const std::vector<float> maps = aleph::all_maps();
    return std::fwrite(maps.data(), sizeof(float), maps.size(), stdout) == maps.size() ? 0 : 1;
}
