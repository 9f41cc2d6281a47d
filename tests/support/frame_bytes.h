#pragma once
// Frames as the bytes of their files, which must not change with threads, order or run.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/with_threads.h"

namespace aleph {

/// scenes/pool, loaded once.
inline const Scene& pool_scene() {
    static const Scene scene = load_scene(source_folder() / "scenes/pool/scene.json");
    return scene;
}

/// Two samples per pixel, so that a later pass of filling happens as well.
inline RenderSettings small_settings() {
    RenderSettings settings = quick_settings(80, 60);
    settings.sampling.spp = 2;
    settings.light.light_samples = 2;
    settings.cache.gather = 32;
    settings.cache.accuracy = 0.4;
    return settings;
}

/// The file of `render --aovs`, byte for byte.
inline std::string frame_bytes(Sequence& sequence, const Scene& scene, const RenderSettings& settings,
                               std::int64_t frame) {
    const ScratchFolder folder;
    const FrameOutput output = sequence.render(frame, {.frame = true, .maps = true, .progress = {}});
    write_exr(folder / "frame.exr", make_frame_image(output, true, scene, settings, sequence.exposure()));
    return read_bytes(folder / "frame.exr");
}

/// The files of these frames, rendered one after the other by so many threads.
inline std::vector<std::string> frame_bytes(int threads, const Scene& scene, const RenderSettings& settings,
                                            const std::vector<std::int64_t>& frames) {
    return with_threads(threads, [&] {
        Sequence sequence(scene, settings);
        std::vector<std::string> files;
        for (const std::int64_t frame : frames) files.push_back(frame_bytes(sequence, scene, settings, frame));
        return files;
    });
}

}  // namespace aleph
