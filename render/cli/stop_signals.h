#pragma once
// Signals that end a render in good order: SIGTERM and SIGINT. What is finished then stays, and is said.

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

namespace aleph {

/// Ends a command that a signal stopped.
class Stopped : public std::runtime_error {
  public:
    Stopped(const std::string& what, int exit_code) : std::runtime_error(what), exit_code_(exit_code) {}
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_;
};

/// Takes SIGTERM and SIGINT during its lifetime, one object at a time, unless they are ignored. A second SIGINT ends
/// the program at once.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that arrived, or 0.
    int received() const;

  private:
    std::array<struct sigaction, 2> before_{};
};

}  // namespace aleph
