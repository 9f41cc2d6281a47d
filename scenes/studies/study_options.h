#pragma once
// What every experiment takes on its command line.

#include <CLI/CLI.hpp>
#include <string>

#include "render/settings.h"

namespace aleph {

struct StudyOptions {
    std::string size = "640x480";  ///< of the frames
    std::string picture{};         ///< .png or .jpg; empty: the experiment makes none
    int gather = 1024, spp = 1, threads = 0;
};

/// --size, --gather, --spp, --threads, and --output where there is a picture.
void add_study_options(CLI::App& app, StudyOptions& options);

/// A scene's settings with these options in their places.
/// @param file  of the scene, for errors
RenderSettings study_settings(const Scene& scene, const std::string& file, const StudyOptions& options);

}  // namespace aleph
