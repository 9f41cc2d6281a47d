#pragma once
// Progress of a command and the time that remains, on standard error.

#include <cstdio>
#include <functional>
#include <mutex>
#include <string>

namespace aleph {

enum class ProgressStyle {
    none,
    lines,  ///< plain lines at growing intervals: logs, pipes
    bar,    ///< one line that is drawn again: terminals
    json,   ///< lines at the same intervals, each a JSON object: other programs
};

/// Form of the output.
struct ProgressLook {
    ProgressStyle style = ProgressStyle::none;
    bool colour = false;
    int columns = 80;
};

/// For standard error: none if quiet, JSON if the form (--progress) is "json", else a bar on a terminal (without colour
/// if NO_COLOR is set), lines elsewhere.
ProgressLook progress_look(bool quiet, const std::string& form = "auto");

/// "3.2s", "1m05s", "2h03m".
std::string format_duration(double seconds);

/// A share as a percentage of two digits: "0.59", "12", "100".
std::string format_percent(double share);

/// Shows progress until it is destroyed. Can be called from any thread.
class Progress {
  public:
    /// @param title  shown first in the line, such as "maps"
    /// @param total  the amount of work, in the caller's unit, such as frames
    /// @param clock  seconds since any start; for tests
    Progress(std::string title, double total, const ProgressLook& look, std::FILE* out = stderr,
             std::function<double()> clock = {});
    /// Shows the last state and ends the line.
    ~Progress();

    /// @param done  of `total`; fractions are fine
    /// @param what  shown last, such as "frame 12: shade"
    void update(double done, const std::string& what = {});

  private:
    void show();

    const std::string title_;
    const double total_;
    const ProgressLook look_;
    std::FILE* const out_;
    const std::function<double()> clock_;
    const double start_;
    std::mutex mutex_;
    struct State {
        double done = 0.0;
        std::string what{};
    };
    State state_;
    double last_shown_, interval_ = 0.25;
    bool shown_ = false, pending_ = false;  ///< a state was shown; the present one is not yet
};

}  // namespace aleph
