#include "render/cli/verify.h"

#include <fmt/format.h>

#include "render/cli/support/progress.h"
#include "render/settings/measure.h"
#include "render/verify/probe.h"

namespace aleph {

namespace {

constexpr std::size_t least_probes = 4;

std::string number(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

VerifiedStatistics verify_frames(VerifyRequest request, PictureKeeper& pictures, std::optional<double> estimated,
                                 const ProgressLook& look) {
    StageClock clock;
    double seconds = 0.0;
    Prober prober(std::move(request.scene), request.settings, request.camera,
                  {request.frames.begin(), request.frames.end()}, pictures);
    std::vector<ProbeResult> probes;
    Progress progress("verify", request.seconds, look);
    while (probes.size() < least_probes || seconds < request.seconds) {
        probes.push_back(prober.measure(probes.size()));
        clock.add_to(seconds);
        const double of_least = static_cast<double>(probes.size()) / static_cast<double>(least_probes);
        progress.update(request.seconds * std::min(seconds / request.seconds, of_least),
                        number(probes.size(), "block"));
    }
    VerifiedStatistics verified = sum_up(probes, request.settings.error > 0.0 ? request.settings.error : 1.0);
    verified.estimated = estimated;
    verified.seconds = seconds;
    return verified;
}

std::string describe_verified(const VerifiedStatistics& verified) {
    const std::string differ = verified.error == 1.0
                                   ? "are seen to differ"
                                   : fmt::format("differ by more than {:g} visible differences", verified.error);
    std::string text = fmt::format("aleph: verified: {} % of the pixels {} (95 %: {} to {} %, {} in {})",
                                   format_percent(verified.beyond.share), differ, format_percent(verified.beyond.low),
                                   format_percent(verified.beyond.high), number(verified.blocks, "block"),
                                   number(verified.frames, "frame"));
    if (verified.estimated) text += fmt::format(", estimated: {} %", format_percent(*verified.estimated));
    text += "\naleph: verified: ";
    if (verified.error != 1.0)
        text += fmt::format("{} % are seen to differ (95 %: {} to {} %), ", format_percent(verified.seen.share),
                            format_percent(verified.seen.low), format_percent(verified.seen.high));
    text += fmt::format("{} % flicker, {} % last; by paths of 16 bounces or more, over {}\n",
                        format_percent(verified.flicker.share), format_percent(verified.lasting.share),
                        number(verified.window, "frame"));
    if (verified.unsettled > 0) {
        text +=
            fmt::format("aleph: verified: in {} noise of the paths was left, so that their shares are less certain\n",
                        number(verified.unsettled, "block"));
    }
    return text;
}

}  // namespace aleph
