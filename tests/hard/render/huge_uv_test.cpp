// Texture coordinates of any size give a finite picture.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/load/load_scene.h"
#include "render/sequence.h"
#include "tests/support/gltf_bad_input.h"
#include "tests/support/quick_settings.h"

namespace aleph {
namespace {

TEST(HugeUv, TexturedPicturesStayFinite) {
    const ScratchFolder folder;
    for (const float huge : {1e7f, 1e18f, 1e30f, -1e30f, std::numeric_limits<float>::max()}) {
        SCOPED_TRACE(huge);
        GltfDraft draft = textured_draft(folder, false);
        draft.primitive()["attributes"]["TEXCOORD_0"] =
            draft.add_accessor<float>({0, 0, huge, -huge, 0.5f * huge, huge}, "VEC2", 2);
        draft.json["nodes"][2] = Json::object();  // loading adds a camera that sees the triangle, and an environment
        write_text(folder / "huge.gltf", draft.to_text());
        const Scene scene = load_scene(folder / "huge.gltf");
        Sequence sequence(scene, quick_settings(24, 18));
        const FrameOutput output = sequence.render(0, {.frame = true, .maps = false, .progress = {}});
        bool lit = false;
        for (const Rgb& pixel : output.shaded.color.pixels) {
            ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z));
            lit = lit || pixel.x > 0.0f;
        }
        EXPECT_TRUE(lit);
    }
}

}  // namespace
}  // namespace aleph
