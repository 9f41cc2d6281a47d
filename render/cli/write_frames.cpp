#include "render/cli/write_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/pose/pose.h"
#include "engine/scene/scene_hash.h"
#include "render/cli/budget.h"
#include "render/cli/film.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/settings/fingerprint.h"
#include "render/verify/probe.h"

namespace aleph {

namespace {

constexpr std::size_t kept_pictures = std::size_t{1} << 30;  // bytes, to be checked
constexpr std::size_t least_probes = 4;

/// @param scene     with what --forbid leaves out
/// @param prepared  says how the frames were rendered
VerifiedStatistics verify_frames(Scene scene, const PreparedScene& prepared, const SceneOptions& options,
                                 PictureKeeper& pictures, double wanted) {
    StageClock clock;
    double seconds = 0.0;
    Prober prober(std::move(scene), prepared.settings, options.camera, {prepared.frames.begin(), prepared.frames.end()},
                  pictures);
    std::vector<ProbeResult> probes;
    Progress progress("verify", wanted, progress_look(options.quiet, options.progress));
    const RenderSignals signals;
    const auto stop_if_asked = [&](double, const char*) {
        signals.stop_if_asked(": all frames are written, and no block is checked");
    };
    while (probes.size() < least_probes || seconds < wanted) {
        try {
            stop_if_asked(0.0, "");
            probes.push_back(prober.measure(probes.size(), stop_if_asked));
        } catch (const Stopped&) {
            if (probes.empty()) throw;
            break;  // what is checked so far is told
        }
        clock.add_to(seconds);
        const double of_least = static_cast<double>(probes.size()) / static_cast<double>(least_probes);
        progress.update(wanted * std::min(seconds / wanted, of_least), count_text(probes.size(), "block"));
    }
    VerifiedStatistics verified = sum_up(probes, prepared.settings.error > 0.0 ? prepared.settings.error : 1.0);
    verified.seconds = seconds;
    return verified;
}

}  // namespace

void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request,
                           const std::string& cache) {
    if (!options.film.empty()) film_rate(options, prepared.frames, prepared.scene.film.frame_rate);
    const auto frames = output_paths(options.output, prepared.name, prepared.frames);
    if (request.maps && request.frame && output_format(frames.front()) == OutputFormat::png) {
        throw InputError("--output", printable(options.output), "PNG cannot hold the channels of maps; write .exr");
    }
    std::vector<OutputFile> outputs;
    if (!options.stats.empty()) outputs.push_back({options.stats, "--stats"});
    const bool keeps_file =
        !cache.empty() && std::filesystem::path(cache).has_filename() && !std::filesystem::is_directory(cache);
    if (keeps_file) outputs.push_back({cache, "--cache"});
    for (const OutputFile& shared : outputs) remove_leftovers(shared.path);
    if (!options.film.empty()) outputs.push_back({options.film, "--output"});
    for (const std::filesystem::path& frame : frames) outputs.push_back({frame, "--output"});
    refuse_overwriting(prepared.read, outputs);
    for (const OutputFile& output : outputs) {
        const bool may_be_complete = output.path == cache && std::filesystem::exists(cache);  // and is not written then
        if (!may_be_complete) try_output(output.path);
    }
}

FrameClaims claim_frames(const PreparedScene& prepared, const SceneOptions& options, const FramePrints& prints) {
    const auto file = [pattern = options.output, name = prepared.name](int frame) {
        return output_path(pattern, name, frame);
    };
    if (options.film.empty()) return FrameClaims({prepared.frames, file, prints.of, prints.identity, options.resume});
    // Processes that divide the frames of a film agree on all of them.
    const std::string film = film_fingerprint(options, prepared.frames, prepared.scene.film.frame_rate, prints.of);
    return FrameClaims({prepared.frames, file, prints.of, film, options.resume,
                        [&options, film] { return is_film_finished(options, film); }});
}

void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request,
                   const std::string& cache, const std::optional<Budget>& budget, double verify) {
    prepare_frames_output(prepared, options, request, cache);
    const ThreadLimit limit(find_threads(options.threads));
    const FramePrints prints = fingerprint_frames(prepared, options, request);
    FrameClaims claims = claim_frames(prepared, options, prints);
    if (options.resume && options.stats.empty() && options.film.empty() &&
        std::ranges::all_of(prepared.frames, [&](int frame) { return claims.is_finished(frame); })) {
        if (!options.quiet) std::cerr << "aleph: all frames were finished before\n";
        return;
    }
    std::optional<Scene> judged;
    if (verify > 0.0) judged = prepared.scene;  // with what --forbid leaves out
    Sequence sequence(std::move(prepared.scene), prepared.settings, options.camera);
    if (!cache.empty()) sequence.load_light(cache);
    PictureKeeper pictures([&](std::int64_t frame) { return std::move(sequence.render(frame).shaded.color); },
                           kept_pictures);
    const auto make = [&](int frame, const FrameRequest& asked) {
        FrameOutput output = sequence.render(frame, asked);
        if (judged) pictures.keep(frame, output.shaded.color);
        return output;
    };
    FrameJob job{sequence.scene(), prepared.settings, sequence.exposure(), make, claims, budget};
    if (!cache.empty()) job.keep_light = [&] { sequence.save_light(); };
    if (judged) {
        judged->film.exposure = sequence.exposure();
        job.verify = [&](std::optional<double> estimated) {
            VerifiedStatistics verified = verify_frames(std::move(*judged), prepared, options, pictures, verify);
            verified.estimated = estimated;
            return verified;
        };
    }
    FrameRequest windowed = request;
    windowed.window = prepared.window;
    write_frames(job, options, windowed);
}

std::string describe_content(const SceneOptions& options, const FrameRequest& request) {
    return fmt::format("{}{}{}{}", request.frame ? "picture " : "", request.maps ? "maps " : "",
                       options.importance ? "importance" : "", options.crop.empty() ? "" : " crop " + options.crop);
}

FramePrints fingerprint_frames(const PreparedScene& prepared, const SceneOptions& options,
                               const FrameRequest& request) {
    const Fingerprint print =
        make_fingerprint(prepared.scene, prepared.settings, list_camera_shots(prepared.scene, options.camera));
    std::string names;  // on which channels of Cryptomatte depend
    for (const Node& node : prepared.scene.nodes) names.append(node.name).push_back('\0');
    const std::string text =
        fmt::format("{}\n{}\n{}", format_fingerprint(print), hash_bytes(names), describe_content(options, request));
    return {hash_bytes(text), [=](int frame) { return hash_bytes(fmt::format("{}\n{}", text, frame)); }};
}

std::string describe_verified(const VerifiedStatistics& verified) {
    const std::string differ = verified.error == 1.0
                                   ? "are seen to differ"
                                   : fmt::format("differ by more than {:g} visible differences", verified.error);
    std::string text = fmt::format("aleph: verified: {} % of the pixels {} (95 %: {} to {} %, {} in {})",
                                   format_percent(verified.beyond.share), differ, format_percent(verified.beyond.low),
                                   format_percent(verified.beyond.high), count_text(verified.blocks, "block"),
                                   count_text(verified.frames, "frame"));
    if (verified.estimated) text += fmt::format(", estimated: {}", describe_estimate(*verified.estimated));
    text += "\naleph: verified: ";
    if (verified.error != 1.0)
        text += fmt::format("{} % are seen to differ (95 %: {} to {} %), ", format_percent(verified.seen.share),
                            format_percent(verified.seen.low), format_percent(verified.seen.high));
    text += fmt::format("{} % flicker, {} % last; by paths of 16 bounces or more, over {}\n",
                        format_percent(verified.flicker.share), format_percent(verified.lasting.share),
                        count_text(verified.window, "frame"));
    if (verified.unsettled > 0) {
        text +=
            fmt::format("aleph: verified: in {} noise of the paths was left, so that their shares are less certain\n",
                        count_text(verified.unsettled, "block"));
    }
    return text;
}

}  // namespace aleph
