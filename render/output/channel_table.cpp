#include "render/output/channel_table.h"

#include <fmt/format.h>

namespace aleph {

namespace {

constexpr const char* as_surfaces = "as for surfaces";

}  // namespace

const std::vector<ChannelInfo>& channel_table() {
    static const std::vector<ChannelInfo> table{
        {{"forward.u", "forward.v"},
         "motion to frame N+1, in the scene's last frame from N-1; pixels, u right, v up",
         "position in frame N+1 minus position in frame N, both at the centre of the shutter; in the scene's last "
         "frame N minus N-1, before a cut 0",
         "pixels, u positive to the right, v positive upwards",
         "motion by the camera's rotation"},
        {{"motion.valid"},
         "1 valid, 0 background, -1 behind the camera, -2 leaves the picture, -3 no counterpart, -4 hidden in frame "
         "N+1",
         "1 valid, 0 background, -1 behind the camera (motion 0), -2 leaves the picture, -3 no counterpart (motion 0; "
         "of pictures that are compared: the motion back does not return), -4 hidden in frame N+1",
         "whole number, -4 to 1",
         "0"},
        {{"backward.u", "backward.v"},
         "motion to frame N-1; pixels, u right, v up",
         "position in frame N-1 minus position in frame N; in the first frame that in N minus that in N+1, behind a "
         "cut 0; not where --motion compares quick estimates of a scene",
         "pixels, u positive to the right, v positive upwards",
         "motion by the camera's rotation"},
        {{"backward.valid"},
         "the same as motion.valid, for backward",
         "the same as motion.valid, for backward: -4 hidden in frame N-1",
         "whole number, -4 to 1",
         "0"},
        {{"velocity.image"},
         "speed on the image, degrees per second",
         "speed on the image",
         "degrees of visual angle per second, 0 and up",
         as_surfaces},
        {{"velocity.retinal"},
         "speed on the retina, degrees per second",
         "speed on the retina of an eye that follows the motion",
         "degrees of visual angle per second, 0 and up",
         as_surfaces},
        {{"saliency.Y"},
         "how likely viewers look here, 0 to 1 (--guide saliency)",
         "how likely viewers look here; with --guide saliency",
         "no unit, 0 to 1",
         as_surfaces},
        {{"conspicuity.intensity", "conspicuity.color", "conspicuity.orientation", "conspicuity.motion"},
         "parts of saliency (--guide saliency)",
         "the four parts of saliency; with --guide saliency",
         "no unit, 0 and up",
         as_surfaces},
        {{"aleph.Y"},
         "contrast elevation, 1 to 250.6",
         "contrast elevation: how many times the least visible contrast goes unseen",
         "no unit, 1 (strictest) to 250.6",
         as_surfaces},
        {{"alpha.acc"},
         "ambient accuracy, 0 to 1",
         "ambient accuracy that the pixel is rendered with",
         "no unit, 0 to 1",
         as_surfaces},
        {{"threshold.Y"},
         "luminance difference that goes unseen, cd/m2",
         "luminance difference on the display that goes unseen, if it lasts",
         "cd/m2, above 0",
         as_surfaces},
        {{"threshold.noise"},
         "noise of single pixels that goes unseen, standard deviation, cd/m2",
         "standard deviation of the luminance of single pixels that goes unseen; new in every frame, but of a camera "
         "that never moves",
         "cd/m2, above 0",
         as_surfaces},
        {{"estimate.R", "estimate.G", "estimate.B"},
         "quick estimate, or the picture of --images; times exposure, linear Rec.709",
         "quick estimate times exposure, the input of the vision model, blurred by shutter and lens; with --images the "
         "picture",
         "radiance, white = 1, 0 and up",
         "environment times exposure"},
        {{"Z"},
         "planar depth, m; 1e30 for background (scene, or the files of --images)",
         "planar depth: distance along the view direction; with --images where the files hold it",
         "m, above 0",
         "1e30"},
        {{"N.X", "N.Y", "N.Z"},
         "normal in the world, towards the viewer (scene)",
         "unit normal towards the viewer, in the world",
         "no unit, -1 to 1",
         "0"},
        {{"objectId.X"},
         "number of the instance, -1 for background (scene); object_ids of `aleph explain --json`",
         "number of the instance that is hit: object_ids of aleph explain --json",
         "whole number, 0 and up",
         "-1"},
        {{"albedo.R", "albedo.G", "albedo.B"},
         "share of light that the surface scatters, for denoisers (scene)",
         "share of light that the surface scatters: Lambert layer, gloss at normal incidence and glass together, with "
         "textures; for denoisers",
         "no unit, 0 to 1",
         "0"},
        {{"effects.R", "effects.G", "effects.B"},
         "what the effects plan leaves out of the pixel, as a colour; render/output/README.md has the colours (scene)",
         "mean colour of the effects that the surface has and that are left out (effects plan); black where all are "
         "simulated",
         "a colour, 0 to 1",
         "0"},
        {{"CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b", "CryptoObject00.a"},
         "Cryptomatte of the objects, by path (scene)",
         "Cryptomatte at the pixel's centre: the path's hash and its coverage, then no second object; the manifest is "
         "in the attributes cryptomatte/...",
         "no unit; coverage 0 or 1",
         "0"},
        // Pictures and the work for them, which `aleph render` alone writes.
        {{"R", "G", "B"},
         "the picture times exposure, linear Rec.709 (render)",
         "picture times exposure, linear Rec.709",
         "radiance, white = 1, 0 and up",
         "environment times exposure"},
        {{"A"},
         "share of the pixel that surfaces cover (render)",
         "share of the pixel's samples that hit a surface",
         "no unit, 0 to 1",
         "0"},
        {{"variance.Y"},
         "variance of the pixel's mean luminance (render, --integrator path)",
         "variance of the pixel's mean luminance times exposure, from its samples: the square of its standard error; "
         "--integrator path with 2 samples or more",
         "radiance squared, white = 1, 0 and up",
         as_surfaces},
        {{"samples.Y"}, "samples taken (render)", "samples taken; render only", "count, 0 and up", "count"},
        {{"records.Y"},
         "irradiance values computed in this pixel (render)",
         "irradiance values computed for this frame in this pixel, without those of lighting keyframes; render only",
         "count, 0 and up",
         "0"},
        {{"invalid.Y"},
         "samples and irradiance values thrown away (render)",
         "samples and irradiance values dropped because they were NaN or infinite; may exceed samples.Y; render only",
         "count, 0 and up",
         "0"},
        {{"error.Y"},
         "estimated error, in visible thresholds (render)",
         "estimated standard error of the luminance, where the visible threshold is known and pixels have several "
         "samples; render only",
         "visible thresholds, 0 and up",
         "0"},
        {{"error.edges", "error.blur", "error.direct", "error.gloss", "error.indirect"},
         "its parts by cause (render)",
         "parts of error.Y: several surfaces in a pixel, shutter or lens, direct light, reflections, cached light; "
         "render only",
         "visible thresholds, 0 and up",
         "0"},
        {{"cache.count"},
         "cache records that indirect light is from (render)",
         "records that indirect light was interpolated from, per sample, those of lighting keyframes included; 0 where "
         "samples cast rays; render only",
         "count, 0 and up",
         "0"},
        {{"cache.radius"},
         "how far these may be used, m (render)",
         "how far these records may be used at the pixel's accuracy, their weighted mean; render only",
         "m, above 0; 0 where cache.count is 0",
         "0"},
    };
    return table;
}

std::string describe_channel(const ChannelInfo& info) {
    return fmt::format("{}; {}; background: {}", info.content, info.range, info.background);
}

}  // namespace aleph
