// Where texture coordinates grow without bound, a texture has its mean colour.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/quick_settings.h"

namespace aleph {
namespace {

/// Renders a triangle whose texture repeats more and more, of the colours a and b.
Image<Rgb> render_with(float huge, const Rgb& a, const Rgb& b) {
    const ScratchFolder folder;
    GltfDraft draft = textured_draft(folder, true);
    Image<Rgb> checker(2, 2, a);
    checker(0, 1) = checker(1, 0) = b;
    write_png(folder / "image.png", checker);
    draft.primitive()["attributes"]["TEXCOORD_0"] =
        draft.add_accessor<float>({0, 0, huge, -huge, 0.5f * huge, huge}, "VEC2", 2);
    draft.json["nodes"][2] = Json::object();  // loading adds a camera that sees the triangle, and an environment
    write_text(folder / "huge.gltf", draft.to_text());
    Scene scene = load_scene(folder / "huge.gltf");
    Sequence sequence(scene, quick_settings(24, 18));
    return sequence.render(0, {.frame = true, .maps = false, .progress = {}}).shaded.color;
}

TEST(HugeUv, ATextureHasItsMeanColour) {
    const Rgb mean = 0.5f * (Rgb(0.8f, 0.1f, 0.3f) + Rgb(0.2f, 0.7f, 0.1f));
    const Image<Rgb> expected = render_with(1.0f, mean, mean);
    for (const float huge : {1e7f, 1e18f, 1e30f, -1e30f, std::numeric_limits<float>::max()}) {
        SCOPED_TRACE(huge);
        const Image<Rgb> found = render_with(huge, {0.8f, 0.1f, 0.3f}, {0.2f, 0.7f, 0.1f});
        int lit = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // The bytes of the file are rounded.
                ASSERT_NEAR(found.pixels[i][c], expected.pixels[i][c], 0.01f * expected.pixels[i][c] + 1e-6f) << i;
            }
            lit += expected.pixels[i].x > 0.0f;
        }
        EXPECT_GT(lit, 20);
    }
}

}  // namespace
}  // namespace aleph
