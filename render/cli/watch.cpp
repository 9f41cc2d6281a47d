#include "render/cli/watch.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "engine/base/errors.h"
#include "render/cli/support/options.h"
#include "render/cli/support/render_signals.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_looks(200);

/// Returns whether the message is about a file, not about an option: names of options stand in place of files too.
bool is_of_file(const InputError& error) {
    return !error.file().empty() && !error.file().starts_with("--");
}

std::string make_packet(const std::string& path, bool again) {
    std::string packet(4, '\0');
    packet += again ? '\1' : '\0';
    packet += again ? '\0' : '\1';
    packet += path;
    packet += '\0';
    for (std::size_t i = 0; i < 4; ++i) packet[i] = static_cast<char>(packet.size() >> (8 * i) & 255u);
    return packet;
}

bool send_all(int connection, std::string_view packet) {
    while (!packet.empty()) {
        const ssize_t sent = ::send(connection, packet.data(), packet.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        packet.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

/// Returns whether the packet could be sent.
bool send_to(const addrinfo& address, const std::string& packet) {
    const int connection = ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC, address.ai_protocol);
    if (connection < 0) return false;
    const timeval patience{1, 0};
    ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    const bool is_sent =
        ::connect(connection, address.ai_addr, address.ai_addrlen) == 0 && send_all(connection, packet);
    ::close(connection);
    return is_sent;
}

/// Files are named by their paths, which mean others on other machines.
bool is_this_machine(const std::string& host) {
    in_addr address{};
    if (::inet_pton(AF_INET, host.c_str(), &address) == 1) return ntohl(address.s_addr) >> 24 == 127;
    return host == "localhost" || host == "::1";
}

void wait_for_change(SceneWatch& watch, const RenderSignals& signals) {
    while (!watch.is_changed()) {
        signals.stop_if_asked();
        std::this_thread::sleep_for(between_looks);
    }
}

}  // namespace

SceneWatch::SceneWatch(const fs::path& scene, const std::string& viewer) : scene_(scene) {
    const std::size_t colon = viewer.rfind(':');
    if (colon != std::string::npos && colon > 0) {
        host_ = viewer.substr(0, colon);
        if (host_.starts_with('[') && host_.ends_with(']')) host_ = host_.substr(1, host_.size() - 2);
        port_ = viewer.substr(colon + 1);
    }
    const auto refuse = [&](const std::string& reason) {
        throw InputError("", "--viewer", "'" + printable(viewer) + "': " + reason);
    };
    int port = 0;
    const auto [end, error] = std::from_chars(port_.data(), port_.data() + port_.size(), port);
    if (error != std::errc() || end != port_.data() + port_.size() || port < 1 || port > 65535)
        refuse("expected HOST:PORT, such as 127.0.0.1:14158, with a port of 1 to 65535");
    if (!is_this_machine(host_)) refuse("the viewer is on this machine: localhost, 127.0.0.1 or [::1]");
}

void SceneWatch::show(const fs::path& file) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    if (::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &list) != 0) return;
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(list, ::freeaddrinfo);
    const fs::path path = fs::absolute(file);
    const std::string packet = make_packet(path.string(), shown_.contains(path));
    for (const addrinfo* address = list; address != nullptr; address = address->ai_next) {
        if (!send_to(*address, packet)) continue;
        shown_.insert(path);
        return;
    }
}

void SceneWatch::note(const ReadFiles& read) {
    const std::lock_guard lock(mutex_);
    files_.clear();
    // The first state of a file that is read twice: a change between the two is one.
    for (std::size_t i = 0; i < read.paths().size(); ++i) files_.emplace(read.paths()[i], read.states()[i]);
    files_.emplace(scene_, file_state(scene_));
    changed_.clear();
}

bool SceneWatch::is_changed() {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (!changed_.empty() || now < next_) return !changed_.empty();
    next_ = now + between_looks;
    const auto found =
        std::ranges::find_if(files_, [](const auto& file) { return file_state(file.first) != file.second; });
    if (found != files_.end()) changed_ = found->first;
    return !changed_.empty();
}

void add_watch_options(CLI::App& app, WatchOptions& options) {
    app.add_flag("--watch", options.watch,
                 "start again whenever the scene file or a file that it uses changes, until Ctrl-C");
    add_text(app, "--viewer", "HOST:PORT", options.viewer,
             "with --watch: a viewer on this machine that shows every file once it is written, tev or another one with "
             "its protocol, if it runs")
        ->capture_default_str()
        ->needs("--watch");
}

void run_maybe_watched(const WatchOptions& asked, SceneOptions& options, const std::function<void()>& run) {
    // From here on, so that none is lost between two renders, and --resume goes on after one that comes while a scene
    // is loaded.
    std::optional<RenderSignals> signals;
    if (asked.watch || options.resume) signals.emplace();
    if (options.time_limit > 0.0) signals->stop_after(options.time_limit);
    if (!asked.watch) return run();
    SceneWatch watch(options.scene, asked.viewer);
    options.watch = &watch;
    for (;;) {
        try {
            run();
        } catch (const SceneChanged&) {
        } catch (const InputError& e) {
            if (!is_of_file(e)) throw;
            std::cerr << fmt::format("aleph: error: {}\n", printable(e.what(), 4000));
        }
        if (!watch.is_changed() && !options.quiet)
            std::cerr << fmt::format("aleph: watching {}; Ctrl-C ends\n", count_text(watch.size(), "file"))
                      << std::flush;
        wait_for_change(watch, *signals);
        if (!options.quiet)
            std::cerr << fmt::format("aleph: {} has changed\n", printable(watch.changed().string(), 400));
        // An editor may write a file in several steps, or remove it before the new one is there.
        std::this_thread::sleep_for(between_looks);
        signals->stop_if_asked();
    }
}

}  // namespace aleph
