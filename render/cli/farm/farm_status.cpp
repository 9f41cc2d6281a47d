#include "render/cli/farm/farm_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/statistics_file.h"
#include "render/cli/write_frames.h"
#include "render/frame/sequence.h"
#include "render/settings/fingerprint.h"
#include "render/settings/frame_list.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

/// The scene of a job's frames with its settings.
PreparedScene prepare_quietly(const FrameCommand& command) {
    SceneOptions options = command.options;
    options.quiet = true;
    PreparedScene prepared = prepare_scene(options);
    if (!command.request.frame) prepared.name += maps_suffix;
    return prepared;
}

void print_frames(const char* what, const std::vector<int>& frames, std::ostream& out) {
    if (!frames.empty()) out << fmt::format("{}: {} ({})\n", what, frames.size(), format_frame_list(frames));
}

}  // namespace

std::vector<int> FarmStatus::left() const {
    std::vector<int> all = missing;
    all.insert(all.end(), damaged.begin(), damaged.end());
    all.insert(all.end(), other.begin(), other.end());
    std::ranges::sort(all);
    return all;
}

FarmStatus find_status(const FarmJob& job, bool decode) {
    const FrameCommand command = parse_frame_command(job);
    const PreparedScene prepared = prepare_quietly(command);
    const FramePrints prints = fingerprint_frames(prepared, command.options, command.request);
    FarmStatus status;
    for (const int frame : prepared.frames) {
        const fs::path file = output_path(job.output, prepared.name, frame);
        const std::optional<std::string> print = read_picture_text(file, fingerprint_key);
        if (!fs::exists(file)) {
            status.missing.push_back(frame);
        } else if (!print) {
            status.damaged.push_back(frame);
        } else if (*print != prints.of(frame)) {
            status.other.push_back(frame);
        } else if (decode && !can_read_image(file)) {
            status.damaged.push_back(frame);
        } else {
            status.finished.push_back(frame);
        }
    }
    return status;
}

void print_status(const FarmStatus& status, std::ostream& out) {
    out << fmt::format("frames: {} of {} finished\n", status.finished.size(),
                       status.finished.size() + status.left().size());
    print_frames("missing", status.missing, out);
    print_frames("damaged", status.damaged, out);
    print_frames("of another scene, other settings or another program", status.other, out);
}

void join_statistics(const FarmJob& job, const FarmStatus& status) {
    if (job.stats.empty()) return;
    std::map<std::string, std::string> rows;
    for (const auto& entry : fs::directory_iterator(job.folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("stats.") && name.ends_with(".json")) rows.merge(read_statistics_rows(entry.path()));
    }
    const FrameCommand command = parse_frame_command(job);
    PreparedScene prepared = prepare_quietly(command);
    const FramePrints prints = fingerprint_frames(prepared, command.options, command.request);
    const Sequence sequence(std::move(prepared.scene), prepared.settings, command.options.camera);
    StatisticsFile file(job.stats, sequence.scene(), prepared.settings, sequence.exposure());
    for (std::size_t i = 0; i < status.finished.size(); ++i) {
        const auto row = rows.find(prints.of(status.finished[i]));
        if (row != rows.end()) file.keep(i, row->second);
    }
    file.finish();
}

}  // namespace aleph
