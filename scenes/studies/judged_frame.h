#pragma once
// What the renderings of a frame are judged by.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/studies/error_runs.h"

namespace aleph {

/// A frame with its reference, which is read or made, and the thresholds of the model of vision in `settings`.
/// @param settings   of every rendering, but for what a run changes
/// @param file       of the scene
/// @param multiples  of the threshold, with which errors are compared
/// @throws InputError if a kept reference is none
JudgedFrame make_judged_frame(const Scene& scene, const RenderSettings& settings, std::int64_t number,
                              const std::string& file, const ReferencePictureOptions& reference,
                              std::vector<double> multiples, bool quiet);

/// --reference-kind, --reference-passes, --reference-spp, --references.
void add_reference_options(CLI::App& app, ReferencePictureOptions& options);

/// load_or_render_reference_picture with a name and an identity for the scene, and progress on standard error.
/// @param file  of the scene
ChannelImage load_judged_reference(const Scene& scene, const RenderSettings& settings, std::int64_t frame,
                                   const std::string& file, ReferencePictureOptions options, bool quiet);

/// Settings of --set that every rendering shares, with the references' filter where the version has one.
/// @param file  of the scene, for errors
/// @throws InputError for a setting that is out of range
RenderSettings judged_settings(const Scene& scene, const std::string& file, const std::string& size,
                               const std::vector<std::string>& sets);

}  // namespace aleph
