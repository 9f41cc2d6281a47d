// --watch: renders again when a file of the scene changes, and outlives broken files.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "engine/image/image_file.h"
#include "tests/render/cli/answers.h"

namespace aleph {
namespace {

/// The text that a program writes into a file, as it comes.
class LogLines {
  public:
    explicit LogLines(fs::path file) : file_(std::move(file)), events_(::inotify_init1(IN_CLOEXEC)) {
        std::ofstream(file_) << "";
        ::inotify_add_watch(events_, file_.c_str(), IN_MODIFY);
    }
    ~LogLines() { ::close(events_); }
    LogLines(const LogLines&) = delete;
    LogLines& operator=(const LogLines&) = delete;

    /// Waits until the text stands in the file so many times. @return whether that was before the program ended
    bool wait(const std::string& text, int times, const StartedProgram& program) const {
        for (;;) {
            const std::string log = read_bytes(file_);
            int found = 0;
            for (std::size_t at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++found;
            if (found >= times) return true;
            pollfd ready[2] = {{events_, POLLIN, 0}, {program.alive(), POLLIN, 0}};
            ::poll(ready, 2, -1);
            if ((ready[0].revents & POLLIN) == 0) return false;
            char buffer[4096];
            if (::read(events_, buffer, sizeof buffer) < 0) return false;
        }
    }

  private:
    const fs::path file_;
    const int events_;
};

/// Takes what is sent to a viewer.
class FakeViewer {
  public:
    FakeViewer() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
        auto* const any = reinterpret_cast<sockaddr*>(&address);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(socket_, any, size), 0);
        EXPECT_EQ(::listen(socket_, 8), 0);
        EXPECT_EQ(::getsockname(socket_, any, &size), 0);
        port_ = ::ntohs(address.sin_port);
    }
    ~FakeViewer() { ::close(socket_); }
    FakeViewer(const FakeViewer&) = delete;
    FakeViewer& operator=(const FakeViewer&) = delete;

    std::string address() const { return fmt::format("127.0.0.1:{}", port_); }

    /// Waits for a connection. @return all that came through it; empty if the program ended before
    std::string receive(const StartedProgram& program) const {
        pollfd ready[2] = {{socket_, POLLIN, 0}, {program.alive(), POLLIN, 0}};
        ::poll(ready, 2, -1);
        if ((ready[0].revents & POLLIN) == 0) return "";
        const int connection = ::accept(socket_, nullptr, nullptr);
        std::string received;
        char buffer[4096];
        for (ssize_t count; (count = ::read(connection, buffer, sizeof buffer)) > 0;)
            received.append(buffer, static_cast<std::size_t>(count));
        ::close(connection);
        return received;
    }

  private:
    const int socket_;
    int port_ = 0;
};

constexpr const char* watching = "; Ctrl-C ends\n";

class Watch : public ProgramTest {
  protected:
    StartedProgram start(const Words& more) const {
        put_lamp("lamp.gltf", "[1, 1, 1]");
        put_paint(Rgb(0.8f));
        put_scene("lamp.gltf");
        const Words words{"render", folder_ / "scene.json", "--size", "16x12", "--spp", "1", "--gather", "4",
                          "--watch"};
        return StartedProgram(joined(words, more), folder_ / "log");
    }
    /// A file in place of another, as editors write it.
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / (name + "~")) << text;
        fs::rename(folder_ / (name + "~"), folder_ / name);
    }
    void put_scene(const std::string& include) const {
        put("scene.json", R"({"aleph": 1, "exposure": 1, "images": {"paint": "paint.png"}, "nodes": [
            {"translation": [0, 1, 5], "camera": {"fov": 40}}, {"include": [")" +
                              include + R"("]},
            {"shape": {"type": "quad", "size": [9, 9]}, "material": {"base_color_texture": "paint"}}]})");
    }
    void put_lamp(const std::string& name, const std::string& color) const {
        put(name, R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"], "extensions":
            {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 4, "color": )" +
                      color + R"(}]}},
            "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"translation": [0, 1, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    }
    void put_paint(const Rgb& color) const { write_png(folder_ / "paint.png", Image<Rgb>(4, 4, color)); }
    Rgb color() const {
        const ChannelImage image = read_image(folder_ / "out.png");
        Rgb sum(0.0f);
        for (int c = 0; c < 3; ++c)
            for (const float value : image.find(std::string(1, "RGB"[c]))->pixels) sum[c] += value / (16 * 12);
        return sum;
    }
};

TEST_F(Watch, RendersAgainWhenAFileOfTheSceneChanges) {
    const LogLines log(folder_ / "log");
    StartedProgram program = start({"--frames", "0", "-o", folder_ / "out.png"});
    ASSERT_TRUE(log.wait(watching, 1, program));
    EXPECT_NEAR(color().r, color().b, 0.02f);
    put_lamp("lamp.gltf", "[1, 0, 0]");
    ASSERT_TRUE(log.wait(watching, 2, program));
    EXPECT_GT(color().r, color().b + 0.1f);
    put_paint(Rgb(0.0f));
    ASSERT_TRUE(log.wait(watching, 3, program));
    EXPECT_LT(color().r, 0.05f);  // what black paint reflects
    EXPECT_THAT(read_bytes(folder_ / "log"), HasSubstr("paint.png has changed"));
    put_lamp("lamp.gltf", "[1, 0, ");  // broken
    ASSERT_TRUE(log.wait(watching, 4, program));
    EXPECT_THAT(read_bytes(folder_ / "log"), HasSubstr("aleph: error: "));
    put_scene("absent.gltf");
    ASSERT_TRUE(log.wait(watching, 5, program));
    EXPECT_THAT(read_bytes(folder_ / "log"), HasSubstr("there is no file"));
    put_paint(Rgb(0.8f));
    put_lamp("absent.gltf", "[0, 0, 1]");  // that was missing
    ASSERT_TRUE(log.wait(watching, 6, program));
    EXPECT_GT(color().b, color().r + 0.1f);
    program.send(SIGINT);
    EXPECT_EQ(program.wait().code, 130);
}

TEST_F(Watch, AViewerShowsTheFileAndReadsItAgain) {
    const FakeViewer viewer;
    const LogLines log(folder_ / "log");
    StartedProgram program = start({"--frames", "0", "-o", folder_ / "out.png", "--viewer", viewer.address()});
    const std::string path = fs::absolute(folder_ / "out.png").string();
    const auto packet = [&](char operation, char to_front) {
        const std::string body = std::string{operation, to_front} + path + '\0';
        return std::string{static_cast<char>(body.size() + 4), '\0', '\0', '\0'} + body;
    };
    ASSERT_LT(path.size(), 100u);
    EXPECT_EQ(viewer.receive(program), packet(0, 1));
    ASSERT_TRUE(log.wait(watching, 1, program));
    put_paint(Rgb(0.1f));
    EXPECT_EQ(viewer.receive(program), packet(1, 0));
    ASSERT_TRUE(log.wait(watching, 2, program));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().code, 130);
}

TEST_F(Watch, AChangeEndsTheRenderThatIsUnderWay) {
    write_sliding_box(folder_ / "scene.json");
    fs::create_directory(folder_ / "out");
    const LogLines log(folder_ / "log");
    FolderEvents events(folder_ / "out");
    StartedProgram program({"render", folder_ / "scene.json", "--size", "16x12", "--spp", "1", "--gather", "4", "-o",
                            folder_ / "out/", "--watch"},
                           folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 2, program));
    std::string scene = read_bytes(folder_ / "scene.json");
    const std::string range = "[1, 5000], \"nodes\"";
    scene.replace(scene.find(range), range.size(), "[9001, 9001], \"nodes\"");
    put("scene.json", scene);
    ASSERT_TRUE(log.wait(watching, 1, program));
    const Words names = names_in(folder_ / "out");
    EXPECT_LT(names.size(), 5000u);
    EXPECT_TRUE(names.back().ends_with("9001.exr")) << names.back();
    for (const std::string& name : names) EXPECT_FALSE(name.starts_with('.')) << name;
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().code, 143);
}

TEST_F(Watch, WrongOptionsEndItAtOnce) {
    for (const Words& wrong :
         {Words{"--frames", "never"}, Words{"-o", folder_ / "x.jpg"}, Words{"--fps", "x"}, Words{"--viewer", "14158"},
          Words{"--viewer", "here:14158x"}, Words{"--viewer", "127.0.0.1:0"}, Words{"--viewer", "127.0.0.1:65536"},
          Words{"--viewer", "192.0.2.1:14158"}}) {
        EXPECT_EQ(start(wrong).wait().code, 2) << wrong[0];
    }
}

}  // namespace
}  // namespace aleph
