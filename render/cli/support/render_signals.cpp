#include "render/cli/support/render_signals.h"

#include <algorithm>
#include <chrono>

#include "render/cli/support/command.h"

namespace aleph {

namespace {

constexpr std::array taken{SIGTERM, SIGINT, SIGUSR1};
volatile std::sig_atomic_t received_signal = 0, status_requests = 0;
int objects = 0;  // that exist

using Clock = std::chrono::steady_clock;
Clock::time_point limited_since, time_limit = Clock::time_point::max();

extern "C" void note_signal(int signal) {
    if (signal == SIGUSR1) {
        status_requests = 1;
    } else if (received_signal == 0) {
        received_signal = signal;
    } else if (signal == SIGINT) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

RenderSignals::RenderSignals() {
    if (objects++ == 0) {
        received_signal = 0;
        status_requests = 0;
        time_limit = Clock::time_point::max();
    }
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < taken.size(); ++i) {
        ::sigaction(taken[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) ::sigaction(taken[i], &action, nullptr);
    }
}

RenderSignals::~RenderSignals() {
    --objects;
    for (std::size_t i = 0; i < taken.size(); ++i) ::sigaction(taken[i], &before_[i], nullptr);
}

void RenderSignals::stop_after(double seconds) {
    const std::chrono::duration<double> left(std::min(seconds, 1e9));
    limited_since = Clock::now();
    time_limit = limited_since + std::chrono::duration_cast<Clock::duration>(left);
}

void RenderSignals::leave_time() const {
    const auto now = Clock::now();
    time_limit = std::max(time_limit, now + (now - limited_since));
}

int RenderSignals::received() const {
    if (received_signal != 0) return received_signal;
    return Clock::now() < time_limit ? 0 : SIGALRM;
}

void RenderSignals::stop_if_asked(const std::string& state, bool goes_on) const {
    const int by = received();
    if (by == 0) return;
    const char* const name = by == SIGINT ? "SIGINT" : by == SIGTERM ? "SIGTERM" : "--time-limit";
    throw Stopped(std::string("stopped by ") + name + state, goes_on ? static_cast<int>(exit_again) : 128 + by);
}

bool RenderSignals::take_status_request() {
    const bool requested = status_requests != 0;
    status_requests = 0;
    return requested;
}

}  // namespace aleph
