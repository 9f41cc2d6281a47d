#pragma once
// Signals while frames are made: SIGTERM, SIGINT and a limit of time end it in good order, SIGUSR1 asks how far it is.

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

namespace aleph {

/// Ends a command with an exit code of its own: a signal stopped it, or its frames err by more than was asked for.
class Stopped : public std::runtime_error {
  public:
    Stopped(const std::string& what, int exit_code) : std::runtime_error(what), exit_code_(exit_code) {}
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_;
};

/// Takes SIGTERM and SIGINT during its lifetime, unless they are ignored. A second SIGINT ends the program at once. An
/// object within the lifetime of another has the same signals.
class RenderSignals {
  public:
    RenderSignals();
    ~RenderSignals();
    RenderSignals(const RenderSignals&) = delete;
    RenderSignals& operator=(const RenderSignals&) = delete;

    /// Ends the command so many seconds from now, whatever object is asked then.
    void stop_after(double seconds);
    /// Moves a limit of time so that what follows has as long as what came before since it was set.
    void leave_time() const;
    /// SIGTERM or SIGINT, whichever arrived first, SIGALRM at the limit of time, or 0.
    int received() const;
    /// @param state    the end of the message: what is finished, and how to go on
    /// @param goes_on  the same command goes on from there
    /// @throws Stopped if one has arrived, with the exit code 75 or that of a program that the signal ended
    void stop_if_asked(const std::string& state = "", bool goes_on = false) const;
    /// Returns whether SIGUSR1 has arrived since this was called last.
    bool take_status_request();

  private:
    std::array<struct sigaction, 3> before_{};
};

}  // namespace aleph
