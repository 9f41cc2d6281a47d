#include "render/cli/support/image_viewer.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <charconv>
#include <memory>
#include <string_view>

#include "engine/base/errors.h"

namespace aleph {

namespace {

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

}  // namespace

ImageViewer::ImageViewer(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    if (colon != std::string::npos && colon > 0) {
        host_ = address.substr(0, colon);
        if (host_.starts_with('[') && host_.ends_with(']')) host_ = host_.substr(1, host_.size() - 2);
        port_ = address.substr(colon + 1);
    }
    const auto refuse = [&](const std::string& reason) {
        throw InputError("", "--viewer", "'" + printable(address) + "': " + reason);
    };
    int port = 0;
    const auto [end, error] = std::from_chars(port_.data(), port_.data() + port_.size(), port);
    if (error != std::errc() || end != port_.data() + port_.size() || port < 1 || port > 65535)
        refuse("expected HOST:PORT, such as 127.0.0.1:14158, with a port of 1 to 65535");
    if (!is_this_machine(host_)) refuse("the viewer is on this machine: localhost, 127.0.0.1 or [::1]");
}

void ImageViewer::show(const std::filesystem::path& file) {
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    if (::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &list) != 0) return;
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(list, ::freeaddrinfo);
    const std::filesystem::path path = std::filesystem::absolute(file);
    const std::string packet = make_packet(path.string(), shown_.contains(path));
    for (const addrinfo* address = list; address != nullptr; address = address->ai_next) {
        if (!send_to(*address, packet)) continue;
        shown_.insert(path);
        return;
    }
}

}  // namespace aleph
