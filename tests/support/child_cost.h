#pragma once
// Time and peak memory of work that runs in its own process, so that one file's peak does not count for another.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <functional>
#include <string>

#include "engine/base/errors.h"

namespace aleph {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
inline constexpr bool limits_count = true;
#else
inline constexpr bool limits_count = false;
#endif

struct ChildCost {
    bool ended_well = false;  ///< it ended by itself, with or without an InputError
    bool refused = false;     ///< with an InputError
    std::string message;      ///< of the InputError, or what else went wrong
    double seconds = 0.0;     ///< of the processor, for the work alone
    double mebibytes = 0.0;   ///< peak of memory, with what the parent held and what was prepared
};

/// Runs `work` in a fork, after `prepare` where there is one. The parent must not have started threads.
inline ChildCost run_in_child(const std::function<void()>& work, const std::function<void()>& prepare = nullptr) {
    ChildCost cost;
    int channel[2];
    if (pipe(channel) != 0) {
        cost.message = "no pipe";
        return cost;
    }
    const pid_t child = fork();
    if (child == 0) {
        if (prepare) prepare();
        const std::clock_t start = std::clock();
        std::string text;
        int code = 0;
        try {
            work();
        } catch (const InputError& error) {
            code = 1;
            text = error.what();
        } catch (const std::exception& error) {
            code = 2;
            text = error.what();
        }
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        text = text.substr(0, 4000);
        if (::write(channel[1], &seconds, sizeof seconds) != sizeof seconds) code = 3;
        if (!text.empty() && ::write(channel[1], text.data(), text.size()) < 0) code = 3;
        _exit(code);
    }
    ::close(channel[1]);
    // A child that a signal ended writes nothing.
    if (::read(channel[0], &cost.seconds, sizeof cost.seconds) < 0) cost.message = "no answer";
    char part[1024];
    for (ssize_t got = 0; (got = ::read(channel[0], part, sizeof part)) > 0;) cost.message.append(part, part + got);
    ::close(channel[0]);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    cost.mebibytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    cost.ended_well = code == 0 || code == 1;
    cost.refused = code == 1;
    return cost;
}

/// At most two seconds and 512 MiB, in the Release build.
inline void expect_bounded(const ChildCost& cost, const std::string& name) {
    EXPECT_TRUE(cost.ended_well) << name << ": " << cost.message;
    if (!limits_count) return;
    EXPECT_LT(cost.seconds, 2.0) << name;
    EXPECT_LT(cost.mebibytes, 512.0) << name;
}

}  // namespace aleph
