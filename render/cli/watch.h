#pragma once
// --watch: a command that is run again whenever a file of its scene changes.

#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "engine/base/files.h"
#include "render/cli/scene_options.h"

namespace aleph {

/// Ends a frame whose scene has changed.
class SceneChanged : public std::exception {};

/// The files that a scene was loaded from, as they were then.
class SceneWatch {
  public:
    /// @param scene   watched also where nothing of it could be read
    /// @param viewer  "HOST:PORT" of a viewer that shows what is made: tev, or another one with its protocol. Over TCP,
    /// the length of the packet in bytes, 32 bits little endian, these four included; a byte for the operation, 0 to
    /// open a file and 1 to read it again; a byte, 1 to bring it to the front; the file's path, ended by 0.
    /// @throws InputError (--viewer) for other text, a port outside 1 to 65535 or a host that is not this one
    SceneWatch(const std::filesystem::path& scene, const std::string& viewer);

    /// Has the viewer show a file. Does nothing where none listens; waits a second at most for one that does not
    /// answer.
    void show(const std::filesystem::path& file);

    /// Takes the files of the scene that is loaded now in place of those before.
    void note(const ReadFiles& read);

    /// Returns whether one of the files is another one, has another time, or is there or not any more. Can be called
    /// from any thread, and often: it asks the system five times a second.
    bool is_changed();

    std::size_t size() const { return files_.size(); }
    /// The file that has changed; empty: none.
    const std::filesystem::path& changed() const { return changed_; }

  private:
    const std::filesystem::path scene_;
    std::map<std::filesystem::path, FileState> files_;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point next_{};
    std::filesystem::path changed_;
    std::string host_, port_;  ///< of the viewer
    std::set<std::filesystem::path> shown_;
};

struct WatchOptions {
    bool watch = false;
    std::string viewer = "127.0.0.1:14158";  ///< where tev listens
};

/// Adds --watch and --viewer.
void add_watch_options(CLI::App& app, WatchOptions& options);

/// Runs a command once, or with --watch until SIGINT or SIGTERM arrives: at once, and after every change of the scene's
/// files. A command that throws SceneChanged is run again. Errors of the scene's files are printed, and the next change
/// is waited for.
/// @param options  whose `watch` is set meanwhile
/// @throws Stopped after a signal; InputError of an option; any other error
void run_maybe_watched(const WatchOptions& asked, SceneOptions& options, const std::function<void()>& run);

}  // namespace aleph
