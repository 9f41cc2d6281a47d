#pragma once
// Shading a frame: its cache is filled, then its pixels take samples until they have enough.

#include "render/pixels/picture_part.h"
#include "render/shade/progressive.h"
#include "render/shade/sample_shading.h"
#include "render/time/keyframe_check.h"
#include "render/time/shutter_keys.h"

namespace aleph {

/// How a frame's samples differ from its pixel centres, and how many there are.
struct SampleOptions {
    Lens lens;                 ///< at its widest while the shutter is open
    bool blended = false;      ///< blended surfaces are in the scene
    bool record_maps = false;  ///< fill ShadedFrame::cache_count and cache_radius
    /// The scene at a sample's time, valid until the next call; empty: the shutter opens for no time.
    /// @param time_class  of the pixel (shutter.h)
    std::function<SampleScene(int sample, int time_class)> at_sample;
    bool light_lasts = true;             ///< while the shutter is open; otherwise that of the frame's time is not used
    std::vector<ShutterSpan> spans;      ///< with light at times of the shutter, in place of the frame's; none: without
    LightChanges from_center;            ///< ShutterTimes::from_center, where `spans` are not used
    const KeyframeRisk* risk = nullptr;  ///< of carried light; null: it need not be checked
    /// Errors that the samples may have; null: not known, which Sampling::uniform alone allows.
    const VisibleLimits* limits = nullptr;
    const Image<Rgb>* estimate = nullptr;     ///< of the frame, with exposure; null: there is none
    const PicturePart* part = nullptr;        ///< pixels that are lit and shaded; null: all
    bool part_picture = false;                ///< a part has a picture too, 0 elsewhere
    bool light_only = false;                  ///< the cache is filled, and nothing shaded
    const PartialPicture* partial = nullptr;  ///< shows the picture so far; may be null
};

/// Shades a frame. With Integrator::cache it fills a cache first; with accuracy 0, every sample casts rays of its own
/// instead. While the shutter is open the scene changes from sample to sample: indirect light is read where it lasts
/// (shutter_light.h), and comes from such rays elsewhere.
/// @param centers  hits through the pixel centres, which are the samples if spp is 1
ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure,
                        const SampleOptions& options = {});

}  // namespace aleph
