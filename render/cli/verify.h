#pragma once
// `aleph render --verify SECONDS`: frames that were rendered are checked in random places.

#include <optional>
#include <string>
#include <vector>

#include "render/cli/scene_options.h"
#include "render/cli/support/progress.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/verify/probe.h"

namespace aleph {

/// The frames that are checked, and for how long.
struct VerifyRequest {
    Scene scene;
    const RenderSettings& settings;
    const std::string& camera;
    const std::vector<int>& frames;
    double seconds;  ///< of a clock; at least four probes are measured
};

/// @param estimated  share of the pixels beyond the error, as rendering estimated it
VerifiedStatistics verify_frames(VerifyRequest request, PictureKeeper& pictures, std::optional<double> estimated,
                                 const ProgressLook& look);

/// "verified: 0.8 % of the pixels are seen to differ (95 %: 0.3 to 1.6 %, 23 blocks in 12 frames), estimated: 0.9 %",
/// and what was judged.
std::string describe_verified(const VerifiedStatistics& verified);

}  // namespace aleph
