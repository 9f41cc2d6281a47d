#pragma once
// Makes the frames of `aleph render` and `aleph maps` one by one, writes each to its file and shows progress.

#include <functional>
#include <optional>
#include <string>

#include "render/cli/frame_writer.h"
#include "render/cli/scene_options.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"

namespace aleph {

struct FramePrints {
    std::string identity;                      ///< what all files have in common
    std::function<std::string(int frame)> of;  ///< of a frame's file
};

/// The fingerprints of frames of a scene, or of their maps.
FramePrints fingerprint_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request);

/// Content of a frame's file, for its fingerprint.
std::string describe_content(const SceneOptions& options, const FrameRequest& request);

/// Checks and tries --output, --stats and --cache, and makes their folders; called before anything is computed.
/// @param maps  the files have channels of maps, which PNG cannot hold beside a picture
/// @throws InputError (--output; a file that is read or written twice), OutputError
void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request,
                           const std::string& cache = "");

FrameClaims claim_frames(const PreparedScene& prepared, const SceneOptions& options, const FramePrints& prints);

/// Renders the frames of a scene, or their maps, and writes them. The files have the channels of what is requested.
/// @param cache  file that keeps the light of lighting keyframes; empty: none
/// @param budget  what they are to take; printed afterwards beside what they took
/// @param verify  seconds to check them afterwards, of a clock; at least four probes are measured; 0: not at all
void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request,
                   const std::string& cache = "", const std::optional<Budget>& budget = std::nullopt,
                   double verify = 0.0);

/// "verified: 0.8 % of the pixels are seen to differ (95 %: 0.3 to 1.6 %, 23 blocks in 12 frames), estimated: 0.9 %",
/// and what was judged.
std::string describe_verified(const VerifiedStatistics& verified);

}  // namespace aleph
