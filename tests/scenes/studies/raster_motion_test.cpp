// Motion from quantized coordinates: its error is half a step of a colour channel, seen in the picture.

#include "scenes/studies/raster_motion.h"
#include "render/frame/sequence.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Largest error, pixels, for a square at rest that is `pixels` wide.
double largest_error(double pixels) {
    Scene scene;
    scene.film.exposure = 1.0;
    add_camera(scene, {0.0, 0.0, 3.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.5;
    add_mesh(scene, make_quad(pixels / 200.0, pixels / 200.0, add_lambert(scene, glm::dvec3(0.5))));
    RenderSettings settings;
    settings.picture.width = settings.picture.height = 200;
    FrameRequest maps;
    maps.frame = false;
    maps.maps = true;
    const FrameOutput output = Sequence(scene, settings).render(0, maps);
    const PosedView other = make_posed_view(scene, 1.0, 0, settings.picture.width, settings.picture.height);
    const MotionField raster = compute_raster_motion(scene, other, output.hits, output.motion);
    double largest = 0.0;
    for (std::size_t i = 0; i < raster.displacement.size(); ++i) {
        const glm::dvec2 error = raster.displacement.pixels[i] - output.motion.displacement.pixels[i];
        largest = std::max(largest, std::hypot(error.x, error.y));
    }
    return largest;
}

TEST(RasterMotion, KeepsEightBitsOfACoordinate) {
    EXPECT_EQ(quantize_coordinate(0.0f), 0.0f);
    EXPECT_EQ(quantize_coordinate(1.0f), 1.0f);
    EXPECT_NEAR(quantize_coordinate(0.3f), 0.3f, 0.5f / 255.0f);
    EXPECT_NE(quantize_coordinate(0.3f), 0.3f);
}

TEST(RasterMotion, RP20_ErrsByHalfAStepOfTheTriangle) {
    const double small = largest_error(20.0), large = largest_error(180.0);
    EXPECT_GT(large, 0.5 * 180.0 / 255.0) << "two coordinates err";
    const double longest_edge = 180.0 * std::sqrt(2.0);
    EXPECT_LT(large, longest_edge / 256.0);
    EXPECT_NEAR(small / large, 20.0 / 180.0, 0.04) << "the error grows with the triangle";
}

}  // namespace
}  // namespace aleph
