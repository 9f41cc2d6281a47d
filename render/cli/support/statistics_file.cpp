#include "render/cli/support/statistics_file.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <utility>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/file_descriptor.h"
#include "engine/base/files.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path rows_file(const std::filesystem::path& path) {
    return hidden_beside(path, "rows");
}

/// Text that is not JSON is discarded. Values nested deeper than those of rows are left out: writing them takes memory
/// by the square of their depth.
Json parse_rows(const std::string& text) {
    constexpr int most_depth = 32;
    return Json::parse(
        text, [](int depth, Json::parse_event_t, const Json&) { return depth < most_depth; }, false);
}

/// Empty where there is no such file.
std::string read_if_there(const std::filesystem::path& path) {
    return std::filesystem::exists(path) ? read_text(path) : std::string();
}

void add_row(const Json& row, std::map<std::string, std::string>& to) {
    if (row.is_object() && row.contains("fingerprint") && row["fingerprint"].is_string())
        to[row["fingerprint"].get<std::string>()] = indent_row(row.dump(2));
}

/// Those of the file of rows.
std::map<std::string, std::string> read_noted_rows(const std::filesystem::path& path) {
    std::map<std::string, std::string> rows;
    std::istringstream lines(read_if_there(rows_file(path)));
    for (std::string line; std::getline(lines, line);) add_row(parse_rows(line), rows);
    return rows;
}

}  // namespace

bool is_write_due(double since, double took) {
    return since >= 10.0 * took;
}

std::map<std::string, std::string> read_statistics_rows(const std::filesystem::path& path) {
    std::map<std::string, std::string> rows;
    const Json whole = parse_rows(read_if_there(path));
    if (whole.is_object() && whole.contains("frames") && whole["frames"].is_array()) {
        for (const Json& row : whole["frames"]) add_row(row, rows);
    }
    rows.merge(read_noted_rows(path));
    return rows;
}

StatisticsFile::StatisticsFile(std::filesystem::path path, const Scene& scene, const RenderSettings& settings,
                               double exposure, const std::optional<BudgetStatistics>& budget)
    : path_(std::move(path)), scene_(scene), settings_(settings), exposure_(exposure), budget_(budget) {}

StatisticsFile::~StatisticsFile() {
    try {
        if (changed_) write();
    } catch (const std::exception&) {  // only while another error is reported
    }
}

StatisticsFile::Row StatisticsFile::append(const std::string& row) {
    const std::filesystem::path path = rows_file(path_);
    if (rows_.get() < 0) rows_ = FileDescriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    // The row before may have been cut, by a process that was killed.
    const std::string line = "\n" + Json::parse(row).dump();
    if (rows_.get() < 0 || !rows_.write(line)) fail_output(path, "cannot write", errno);
    const off_t end = ::lseek(rows_.get(), 0, SEEK_CUR);  // of what was appended, whoever else appends
    return {end - static_cast<off_t>(line.size()) + 1, line.size() - 1};
}

std::string StatisticsFile::text_of(const std::variant<Row, std::string>& frame) const {
    if (const auto* text = std::get_if<std::string>(&frame)) return *text;
    const Row& row = std::get<Row>(frame);
    std::string line(row.size, '\0');
    if (::pread(rows_.get(), line.data(), line.size(), row.begin) != static_cast<ssize_t>(line.size()))
        throw OutputError(printable(rows_file(path_).string(), 4096), "cannot read back what was written");
    return indent_row(Json::parse(line).dump(2));
}

void StatisticsFile::note(const FrameStatistics& frame, const std::string& fingerprint) {
    if (!path_.empty()) append(format_frame_statistics(frame, fingerprint));
}

std::map<std::string, std::string> StatisticsFile::take_over() {
    std::map<std::string, std::string> rows = read_statistics_rows(path_);
    const std::map<std::string, std::string> noted = read_noted_rows(path_);
    for (const auto& [fingerprint, row] : rows)
        if (!noted.contains(fingerprint)) append(row);
    return rows;
}

void StatisticsFile::add(std::size_t place, const FrameStatistics& frame, const std::string& fingerprint) {
    if (path_.empty()) return;
    frames_[place] = append(format_frame_statistics(frame, fingerprint));
    changed_ = true;
    clock_.add_to(since_);
    if (is_write_due(since_, took_)) write();
}

void StatisticsFile::keep(std::size_t place, const std::string& row) {
    if (path_.empty() || frames_.contains(place)) return;
    frames_[place] = row;
    changed_ = true;
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
    if (path_.empty()) return;
    if (changed_ || frames_.empty()) write();
    std::error_code error;
    std::filesystem::remove(rows_file(path_), error);
}

void StatisticsFile::write() {
    StageClock writing;
    constexpr std::string_view mark("\1");  // nowhere else in the text
    const std::string text =
        format_statistics(frames_.empty() ? "" : mark, scene_, settings_, exposure_, budget_, verified_);
    const std::size_t middle = std::min(text.find(mark), text.size());
    write_atomically(path_, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text.substr(0, middle);
        const char* before = "";
        for (const auto& [place, row] : frames_) out << std::exchange(before, ",\n") << text_of(row);
        if (!frames_.empty()) out << text.substr(middle + mark.size());
        if (!out.flush()) throw OutputError(printable(path_.string(), 4096), "cannot write the statistics");
    });
    changed_ = false;
    took_ = since_ = 0.0;
    writing.add_to(took_);
    clock_ = {};
}

}  // namespace aleph
