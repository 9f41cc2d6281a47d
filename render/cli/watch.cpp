#include "render/cli/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <thread>

#include "engine/base/errors.h"
#include "render/cli/support/render_signals.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_looks(200);

/// Returns whether the message is about a file, not about an option: names of options stand in place of files too.
bool is_of_file(const InputError& error) {
    return !error.file().empty() && !error.file().starts_with("--");
}

void wait_for_change(SceneWatch& watch, const RenderSignals& signals) {
    while (!watch.is_changed()) {
        signals.stop_if_asked();
        std::this_thread::sleep_for(between_looks);
    }
}

}  // namespace

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
            std::cerr << fmt::format("aleph: watching {} file{}; Ctrl-C ends\n", watch.size(),
                                     watch.size() == 1 ? "" : "s")
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
