#pragma once
// The viewer test of a study as one HTML file: do people see what the models of vision say? (Yee 2000, 7.1, asked a
// panel of viewers.) Each trial shows the reference and a variant, one after the other, and asks which had the errors.

#include <string>
#include <string_view>

#include "render/study/run_study.h"
#include "render/study/study_files.h"

namespace aleph {

/// The bundled page with a place for data; empty where the program was built without it.
std::string_view viewer_template();

/// The page with the frames of the study's scenes, in their order, as 8-bit sRGB pictures, with the viewing conditions
/// of each scene. The level of a variant is the factor of its noise, or its value of the first sweep with numbers;
/// without one there is none, and no function is fitted.
/// @param page  viewer_template()
/// @throws InputError if a picture of a run cannot be read
std::string make_viewer_test(std::string_view page, const PreparedStudy& prepared, const StudyResults& results,
                             const StudyContext& context);

}  // namespace aleph
