#pragma once
// Progressive sampling: which pixels take how many more samples, stage by stage.

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "render/guide/stopping_rule.h"
#include "render/pixels/picture_part.h"

namespace aleph {

/// How many samples pixels take.
struct SamplingPlan {
    Sampling rule = Sampling::uniform;
    Stopping stopping = Stopping::neighbourhood;
    const StoppingRule* own = nullptr;  ///< decides in their place
    int most = 1;                       ///< samples of a pixel
    Image<float> tolerance;   ///< of luminance, in the samples' unit (is_enough); empty for `uniform` and `protocol`
    Image<float> aleph;       ///< for `protocol`
    Image<Outline> outlines;  ///< for `threshold`; empty: none
    Image<int> least;         ///< for `threshold`: samples before the rule is asked first; empty: no more than usual
    int reach = 1;            ///< for `threshold`: pixels on either side that are seen together (find_seen_reach)
    double white = std::numeric_limits<double>::infinity();  ///< for `threshold`: radiance that is shown as white
    const PicturePart* part = nullptr;                       ///< pixels that take samples; null: all
};

/// Samples of one pixel: those from `first` up to, not including, `last`.
struct PixelRange {
    int x = 0, y = 0;
    int first = 0, last = 0;
};

double sum_samples(std::span<const PixelRange> ranges);

/// Pixels of a task: so many that tasks take about equal times.
std::size_t find_task_ranges(std::span<const PixelRange> ranges);

/// The samples that stages after this one are expected to take, for progress: the share of the pixels that goes on is
/// taken to stay what it was, or to be what is typical if that is more.
/// @param before  pixels of the stage before; 0 if this is the first
double predict_samples(std::span<const PixelRange> stage, std::size_t before, int most);

/// One sample of all pixels of a class (shutter.h) after the other: each has a time of its own.
using TakeSample = std::function<void(int sample, int pixel_class, std::span<const PixelRange> ranges)>;
void take_in_turn(std::span<const PixelRange> ranges, const TakeSample& take);

/// Adds samples to the pixels. The ranges go from row to row.
using TakeSamples = std::function<void(std::span<const PixelRange> ranges)>;

/// Takes samples until the rule stops at every pixel. At each stage the pixels that do not have enough double their
/// samples. A decision reads what all pixels have after a stage, so the result does not depend on the number of
/// threads. A pixel that stopped never goes on: it would when its neighbours, which go on because of its own rare
/// bright sample, meet another, and then that sample is averaged away. With `threshold`, a pixel whose own samples say
/// otherwise (stands_out) keeps its mean and goes on: spread_lost_light (resolve.h) has to follow.
/// @param pixels  what `take` adds to; read between stages
/// @param begin   the stage to begin with; empty: the first
void sample_by_stages(const SamplingPlan& plan, Image<PixelSamples>& pixels, const TakeSamples& take,
                      std::vector<PixelRange> begin = {});

/// The luminance that samples may err by, as they have it (before exposure).
/// threshold: allow_noise of RenderSettings::error, times what noise of single pixels goes unseen.
/// consecutive, variance: RenderSettings::error times the threshold.
/// Beside the outline of a moving object, or of one smaller than pixels, it is the strictest of the nine around the
/// pixel (README.md).
/// @return empty for rules that need none
Image<float> compute_sampling_tolerance(const VisibleLimits& limits, const RenderSettings& settings, double exposure);

/// @param limits  null: not known, which Sampling::uniform alone allows
SamplingPlan make_sampling_plan(const VisibleLimits* limits, const RenderSettings& settings, double exposure);

}  // namespace aleph
