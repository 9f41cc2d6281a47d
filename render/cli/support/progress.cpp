#include "render/cli/support/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

namespace aleph {

namespace {

constexpr double redraw_interval = 0.1;  ///< seconds between two drawings of the bar
constexpr double max_line_interval = 5;  ///< seconds between two plain lines; the first interval is .25

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A full disk or a closed terminal is no reason to end a render, so errors are not looked at.
void write(const std::string& text, std::FILE* out) {
    std::fwrite(text.data(), 1, text.size(), out);
    std::fflush(out);
}

}  // namespace

ProgressLook progress_look(bool quiet, const std::string& form) {
    if (quiet) return {};
    if (form == "json") return {ProgressStyle::json, false, 80};
    const char* terminal = std::getenv("TERM");
    if (!::isatty(STDERR_FILENO) || !terminal || std::string_view(terminal) == "dumb") {
        return {ProgressStyle::lines, false, 80};
    }
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    const char* no_colour = std::getenv("NO_COLOR");  // no-color.org: set and not empty
    return {ProgressStyle::bar, !no_colour || !*no_colour, known ? size.ws_col : 80};
}

std::string format_percent(double share) {
    if (share < 1e-9) return "0";
    return share < 0.0995 ? fmt::format("{:.2g}", 100.0 * share) : fmt::format("{:.0f}", 100.0 * share);
}

std::string format_duration(double seconds) {
    if (!(seconds >= 0.0)) return "?";
    if (seconds < 59.95) return fmt::format("{:.1f}s", seconds);
    const auto whole = static_cast<long long>(std::min(seconds, 1e12) + 0.5);
    if (whole < 3600) return fmt::format("{}m{:02}s", whole / 60, whole % 60);
    return fmt::format("{}h{:02}m", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(std::string title, double total, const ProgressLook& look, std::FILE* out,
                   std::function<double()> clock)
    : title_(std::move(title)),
      total_(std::max(total, 1e-9)),
      look_(look),
      out_(out),
      clock_(clock ? std::move(clock) : steady_seconds),
      start_(clock_()),
      last_shown_(start_) {}

Progress::~Progress() {
    const std::lock_guard lock(mutex_);
    if (pending_) show();
    if (shown_ && look_.style == ProgressStyle::bar) std::fputc('\n', out_);
}

void Progress::update(double done, const std::string& what) {
    if (look_.style == ProgressStyle::none) return;
    const std::lock_guard lock(mutex_);
    state_ = {std::clamp(done, 0.0, total_), what};
    pending_ = true;
    const double now = clock_();
    const bool bar = look_.style == ProgressStyle::bar;
    if (now - last_shown_ < (bar ? redraw_interval : interval_) && (shown_ || !bar)) return;
    last_shown_ = now;
    interval_ = std::min(max_line_interval, interval_ * 2.0);
    show();
}

void Progress::show() {
    shown_ = true;
    pending_ = false;
    const double share = state_.done / total_, elapsed = clock_() - start_;
    const double remaining =
        state_.done > 0.0 ? elapsed * (total_ - state_.done) / state_.done : std::nan("");  // null in JSON
    if (look_.style == ProgressStyle::json) {
        const nlohmann::ordered_json line{{"progress", title_},
                                          {"share", share},
                                          {"elapsed", elapsed},
                                          {"remaining", remaining},
                                          {"what", state_.what}};
        write(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n", out_);
        return;
    }
    const std::string times = fmt::format("({}|{})", format_duration(elapsed), format_duration(remaining));
    if (look_.style == ProgressStyle::lines) {
        write(fmt::format("{} {:3.0f}% {} {}\n", title_, 100.0 * share, times, state_.what), out_);
        return;
    }
    const std::string tail = fmt::format(" {:3.0f}% {} {}", 100.0 * share, times, state_.what);
    const int room = look_.columns - static_cast<int>(title_.size() + tail.size()) - 5;
    const int width = std::clamp(room, 0, 40), filled = static_cast<int>(share * width);
    std::string line = title_ + " ";
    if (width >= 5) {
        line += fmt::format("[{}{}{}{}]", look_.colour ? "\x1b[32m" : "",
                            std::string(static_cast<std::size_t>(filled), '='), look_.colour ? "\x1b[0m" : "",
                            std::string(static_cast<std::size_t>(width - filled), ' '));
        line += tail;
    } else {
        line = (line + tail).substr(0, static_cast<std::size_t>(std::max(1, look_.columns - 1)));
    }
    write(fmt::format("\r{}\x1b[K", line), out_);
}

}  // namespace aleph
