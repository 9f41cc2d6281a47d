#pragma once
// Pictures that judge others: rendered once, kept as files, and refined on demand.

#include <filesystem>
#include <functional>

#include "engine/image/image_file.h"
#include "render/compare/reference_passes.h"
#include "render/study/prepared_study.h"

namespace aleph {

struct ReferencePicture {
    ChannelImage picture;
    std::filesystem::path file;  ///< that keeps it; other builds of the program (program_build) have other files
};

/// Called as a reference is made, with the renderings that are finished.
using ReferenceProgress = std::function<void(double passes)>;

/// R, G, B, `indirect.R/G/B` unless it is traced, and `variance.Y` of a frame without a guide, with random numbers of
/// its own. It is the mean of the passes of Study::reference, whose differences tell its variance. Longest path, filter
/// and levels of cages are those of the settings; there are at least 16 diffuse bounces unless the study names them.
/// Reads the file of this scene, frame and size if there is one, and adds the passes that it lacks. The file is written
/// after every pass, so that a run can be stopped and taken up.
/// @param folder  that keeps references, since they take minutes
/// @throws InputError if the kept file is not such a reference
ReferencePicture find_or_make_reference(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                                        const std::filesystem::path& folder, const ReferenceProgress& progress);

/// Returns whether find_or_make_reference would find the picture with all of its passes.
/// @throws InputError if the kept file is not such a reference
bool is_reference_finished(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                           const std::filesystem::path& folder);

/// Channels of the part of a picture that surfaces reflect of their indirect irradiance: indirect.R and so on.
inline constexpr const char* indirect_layer = "indirect.";

}  // namespace aleph
