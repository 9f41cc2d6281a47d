#include "render/cli/support/film_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ranges>
#include <string_view>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/base/file_descriptor.h"

extern char** environ;

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr int poll_milliseconds = 200;
constexpr std::size_t errors_kept = 2000;  // bytes

struct Ends {
    FileDescriptor ours, theirs;
};

/// A process, killed at the end of the scope unless it has been waited for.
class Process {
  public:
    explicit Process(pid_t id) : id_(id) {}
    ~Process() {
        if (id_ <= 0) return;
        ::kill(id_, SIGKILL);
        wait();
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    int wait() {
        int status = 0;
        while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
        }
        id_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t id_;
};

pid_t start(const fs::path& program, const std::vector<std::string>& arguments, int input, int errors) {
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), program.string());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t id = 0;
    const int error = ::posix_spawn(&id, program.c_str(), &files, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) fail_output(program, "cannot start the program", error);
    return id;
}

/// The bytes that are yet to be sent. A program that has closed its input gets no more.
class Feed {
  public:
    Feed(FileDescriptor input, const std::function<Bytes()>& next) : input_(std::move(input)), next_(next) {}

    /// The descriptor to wait for; -1: nothing is left.
    int prepare() {
        if (input_.get() >= 0 && sent_ == piece_.size()) {
            piece_ = next_();
            sent_ = 0;
            if (piece_.empty()) {
                took_all_ = true;
                input_.close();
            }
        }
        return input_.get();
    }
    void send() {
        const ssize_t size =
            ::send(input_.get(), piece_.data() + sent_, piece_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (size >= 0) {
            sent_ += static_cast<std::size_t>(size);
        } else if (errno != EAGAIN && errno != EINTR) {
            input_.close();
        }
    }
    bool took_all() const { return took_all_; }

  private:
    FileDescriptor input_;
    const std::function<Bytes()>& next_;
    Bytes piece_;
    std::size_t sent_ = 0;
    bool took_all_ = false;
};

/// Adds what is there to read to a text and keeps its end. Returns whether more may come.
bool read_some(int file, std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t size = ::read(file, buffer.data(), buffer.size());
    if (size < 0) return errno == EINTR || errno == EAGAIN;
    text.append(buffer.data(), static_cast<std::size_t>(size));
    if (text.size() > errors_kept) text.erase(0, text.size() - errors_kept);
    return size > 0;
}

}  // namespace

fs::path find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    for (const auto folder : std::views::split(std::string_view(path == nullptr ? "" : path), ':')) {
        const fs::path file = fs::path(folder.begin(), folder.end()) / name;
        std::error_code error;
        if (fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

ProgramEnd run_fed(const fs::path& program, const std::vector<std::string>& arguments,
                   const std::function<Bytes()>& next, const std::function<void()>& check) {
    int sockets[2], pipes[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) fail_output(program, "no socket", errno);
    Ends input{FileDescriptor(sockets[0]), FileDescriptor(sockets[1])};
    if (::pipe2(pipes, O_CLOEXEC) != 0) fail_output(program, "no pipe", errno);
    Ends errors{FileDescriptor(pipes[0]), FileDescriptor(pipes[1])};
    Process process(start(program, arguments, input.theirs.get(), errors.theirs.get()));
    input.theirs.close();
    errors.theirs.close();
    Feed feed(std::move(input.ours), next);
    ProgramEnd end;
    for (bool more = true; more;) {
        check();
        pollfd ready[2] = {{errors.ours.get(), POLLIN, 0}, {feed.prepare(), POLLOUT, 0}};
        if (::poll(ready, 2, poll_milliseconds) <= 0) continue;
        if (ready[1].revents != 0) feed.send();
        if (ready[0].revents != 0) more = read_some(errors.ours.get(), end.errors);
    }
    end.took_all = feed.took_all();
    end.code = process.wait();
    return end;
}

}  // namespace aleph
