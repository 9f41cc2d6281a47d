#pragma once
// The --stats file while frames are made: it has the finished frames, and writing it takes little of their time.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "engine/base/file_descriptor.h"
#include "render/output/frame_files.h"
#include "render/settings/measure.h"

namespace aleph {

/// Returns whether the file is to be written again. All of it is written each time, which takes longer the more frames
/// it has: at most a tenth of the time goes into that. Frames that take longer are in the file as soon as they are
/// finished.
/// @param since  seconds since it was written last
/// @param took  seconds which that took
bool is_write_due(double since, double took);

/// The text of each frame in a statistics file, and of frames that an unfinished file has not yet, by the fingerprint
/// of the frame's file. A file that is no statistics file has none.
std::map<std::string, std::string> read_statistics_rows(const std::filesystem::path& path);

class StatisticsFile {
  public:
    /// Takes what the file says of all frames. The references must outlive this object.
    /// @param path  empty: no file is written
    StatisticsFile(std::filesystem::path path, const Scene& scene, const RenderSettings& settings, double exposure,
                   const std::optional<BudgetStatistics>& budget = std::nullopt);

    /// Writes what is not written yet, as far as possible: the program has failed elsewhere and says so there.
    ~StatisticsFile();

    /// Notes a frame whose file is about to be written: a process that is killed then loses no row of a finished frame.
    /// @throws OutputError
    void note(const FrameStatistics& frame, const std::string& fingerprint);

    /// Reads the rows of earlier runs, and notes those that are not: a stop then loses none, whether its frame comes up
    /// or not.
    /// @return by fingerprint, as read_statistics_rows
    /// @throws OutputError
    std::map<std::string, std::string> take_over();

    /// Adds a finished frame. The first is written at once, others when that is due.
    /// @param place        of the frame among all
    /// @param fingerprint  of the frame's file
    /// @throws OutputError
    void add(std::size_t place, const FrameStatistics& frame, const std::string& fingerprint);

    /// Adds a frame that was finished before, as read_statistics_rows found it.
    /// @throws OutputError
    void keep(std::size_t place, const std::string& row);

    /// Says what the budget came to. `finish` then writes the file with it.
    void set_budget(const BudgetStatistics& budget);

    /// Says what verification found; the same.
    void set_verified(const VerifiedStatistics& verified);

    /// Writes what is not written yet; the file without frames where there are none. Rows of frames that were only
    /// noted or taken over go.
    /// @throws OutputError
    void finish();

  private:
    /// Where a row is in the file of rows, bytes.
    struct Row {
        off_t begin = 0;
        std::size_t size = 0;
    };

    Row append(const std::string& row);
    std::string text_of(const std::variant<Row, std::string>& frame) const;
    void write();

    std::filesystem::path path_;
    const Scene& scene_;
    const RenderSettings& settings_;
    double exposure_;
    std::optional<BudgetStatistics> budget_;
    std::optional<VerifiedStatistics> verified_;
    /// `.NAME.rows` beside the file: rows as they came, one JSON a line, so that a long sequence takes no memory.
    /// Removed by `finish`.
    FileDescriptor rows_;
    std::map<std::size_t, std::variant<Row, std::string>> frames_;  ///< by place; of `keep` the text
    bool changed_ = false;
    StageClock clock_;
    double since_ = 0.0;  ///< seconds since the file was written
    double took_ = 0.0;   ///< seconds that this took
};

}  // namespace aleph
