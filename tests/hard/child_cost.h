#pragma once
// What a piece of work costs in a process of its own, so that one file's peak memory is not another's.

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
    double seconds = 0.0;     ///< of the processor, so that a busy machine changes nothing
    double mebibytes = 0.0;   ///< peak of memory, with what the parent held
};

/// Runs `work` in a fork. The parent must not have started threads.
inline ChildCost run_in_child(const std::function<void()>& work) {
    ChildCost cost;
    int channel[2];
    if (pipe(channel) != 0) {
        cost.message = "no pipe";
        return cost;
    }
    const pid_t child = fork();
    if (child == 0) {
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
        text = text.substr(0, 4000);
        if (!text.empty() && write(channel[1], text.data(), text.size()) < 0) code = 3;
        _exit(code);
    }
    close(channel[1]);
    char part[1024];
    for (ssize_t got = 0; (got = read(channel[0], part, sizeof part)) > 0;) cost.message.append(part, part + got);
    close(channel[0]);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    cost.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    cost.mebibytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    cost.ended_well = code == 0 || code == 1;
    cost.refused = code == 1;
    return cost;
}

/// Two seconds and 512 MiB, where the build is one that people use.
inline void expect_bounded(const ChildCost& cost, const std::string& name) {
    EXPECT_TRUE(cost.ended_well) << name << ": " << cost.message;
    if (!limits_count) return;
    EXPECT_LT(cost.seconds, 2.0) << name;
    EXPECT_LT(cost.mebibytes, 512.0) << name;
}

}  // namespace aleph
