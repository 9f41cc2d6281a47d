#pragma once
// The program in a process of its own, and the files that it writes while it runs.

#include <fcntl.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {

/// A box that slides for 5000 frames.
inline void write_sliding_box(const std::filesystem::path& path, const std::string& light = "30") {
    std::ofstream(path) << R"({"aleph": 1, "exposure": 1, "frames": [1, 5000], "nodes": [
        {"translation": [0, 1, 5], "camera": {"fov": 40}}, {"translation": [0, 3, 1], "light": {"type": "point", "intensity": )"
                        << light << R"(}},
        {"shape": {"type": "quad", "size": [9, 9]}, "rotation": {"axis": [1, 0, 0], "degrees": -90}},
        {"shape": {"type": "box", "size": [1, 1, 1]}, "translation": {"keys": [[1, [-1, 0.5, 0]], [5000, [1, 0.5, 0]]]}}]})";
}

/// The way a process ended.
struct Ended {
    int code = -1;    ///< -1 if a signal ended it
    int signal = 0;   ///< that ended it
    std::string err;  ///< what it printed on standard error
};

class StartedProgram {
  public:
    /// @param words  what follows `aleph`
    /// @param log    file for standard error
    /// @param before  called in the new process, before the program begins
    StartedProgram(std::vector<std::string> words, std::filesystem::path log, const std::function<void()>& before = {})
        : log_(std::move(log)) {
        words.insert(words.begin(), program_path("aleph"));
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        int alive[2];
        if (::pipe2(alive, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        child_ = ::fork();
        if (child_ == 0) {
            ::fcntl(alive[1], F_SETFD, 0);
            ::dup2(::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
            std::signal(SIGINT, SIG_DFL);
            if (before) before();
            ::execv(argv.front(), argv.data());
            ::_exit(127);
        }
        ::close(alive[1]);
        alive_ = alive[0];
    }
    ~StartedProgram() {
        if (child_ > 0) {
            send(SIGKILL);
            wait();
        }
        ::close(alive_);
    }
    StartedProgram(const StartedProgram&) = delete;
    StartedProgram& operator=(const StartedProgram&) = delete;

    void send(int signal) const { ::kill(child_, signal); }
    /// A descriptor that is closed at the other end when the program ends.
    int alive() const { return alive_; }
    Ended wait() {
        int status = 0;
        ::waitpid(std::exchange(child_, -1), &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                read_bytes(log_)};
    }

  private:
    std::filesystem::path log_;
    pid_t child_ = -1;
    int alive_ = -1;
};

/// Events of a folder: files that a program writes into it.
class FolderEvents {
  public:
    explicit FolderEvents(const std::filesystem::path& folder) : file_(::inotify_init1(IN_CLOEXEC)) {
        ::inotify_add_watch(file_, folder.c_str(), IN_CREATE | IN_MOVED_TO);
    }
    ~FolderEvents() { ::close(file_); }
    FolderEvents(const FolderEvents&) = delete;
    FolderEvents& operator=(const FolderEvents&) = delete;

    /// Waits until a file has been created, or has got its final name, so many times.
    /// @return whether that happened before the program ended
    bool wait(std::uint32_t kind, int times, const StartedProgram& program) {
        alignas(inotify_event) char buffer[4096];
        while (times > 0) {
            pollfd ready[2] = {{file_, POLLIN, 0}, {program.alive(), POLLIN, 0}};
            ::poll(ready, 2, -1);
            if ((ready[0].revents & POLLIN) == 0) return false;
            const ssize_t size = ::read(file_, buffer, sizeof buffer);
            for (ssize_t at = 0; at < size;) {
                const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
                if ((event->mask & kind) != 0) --times;
                at += static_cast<ssize_t>(sizeof(inotify_event)) + event->len;
            }
        }
        return true;
    }

  private:
    int file_;
};

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

}  // namespace aleph
