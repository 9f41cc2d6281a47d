#include "render/cli/statistics_file.h"

#include <exception>
#include <utility>

#include "engine/base/atomic_file.h"

namespace aleph {

bool is_write_due(double since, double took) {
    return since >= 10.0 * took;
}

StatisticsFile::StatisticsFile(std::filesystem::path path, const Scene& scene, const RenderSettings& settings,
                               double exposure, const std::optional<BudgetStatistics>& budget)
    : path_(std::move(path)), scene_(scene), settings_(settings), exposure_(exposure), budget_(budget) {}

StatisticsFile::~StatisticsFile() {
    try {
        finish();
    } catch (const std::exception&) {  // only while another error is reported
    }
}

void StatisticsFile::add(const FrameStatistics& frame) {
    if (path_.empty()) return;
    if (!frames_.empty()) frames_ += ",\n";
    frames_ += format_frame_statistics(frame);
    changed_ = true;
    clock_.add_to(since_);
    if (is_write_due(since_, took_)) write();
}

void StatisticsFile::set_budget(const BudgetStatistics& budget) {
    budget_ = budget;
    changed_ = !path_.empty();
}

void StatisticsFile::set_verified(const VerifiedStatistics& verified) {
    verified_ = verified;
    changed_ = !path_.empty();
}

void StatisticsFile::finish() {
    if (changed_) write();
}

void StatisticsFile::write() {
    StageClock writing;
    write_file(path_, format_statistics(frames_, scene_, settings_, exposure_, budget_, verified_));
    changed_ = false;
    took_ = since_ = 0.0;
    writing.add_to(took_);
    clock_ = {};
}

}  // namespace aleph
