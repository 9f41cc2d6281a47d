#include "render/cli/stop_signals.h"

namespace aleph {

namespace {

constexpr std::array stopping{SIGTERM, SIGINT};
volatile std::sig_atomic_t received_signal = 0;

extern "C" void note_signal(int signal) {
    if (received_signal == 0) {
        received_signal = signal;
    } else if (signal == SIGINT) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

StopSignals::StopSignals() {
    received_signal = 0;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < stopping.size(); ++i) {
        ::sigaction(stopping[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) ::sigaction(stopping[i], &action, nullptr);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < stopping.size(); ++i) ::sigaction(stopping[i], &before_[i], nullptr);
}

int StopSignals::received() const {
    return received_signal;
}

}  // namespace aleph
