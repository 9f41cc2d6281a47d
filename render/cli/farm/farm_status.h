#pragma once
// What a job's tasks have made: which frames are finished, missing, damaged or of something else.

#include <ostream>
#include <vector>

#include "render/cli/farm/farm_job.h"

namespace aleph {

struct FarmStatus {
    std::vector<int> finished, missing;
    std::vector<int> damaged;  ///< cut, or not to be decoded
    std::vector<int> other;    ///< of another scene, other settings or another program

    /// All frames that are not finished.
    std::vector<int> left() const;
};

/// Finds the state of all frames by their files.
/// @param decode  every pixel is read
/// @throws InputError
FarmStatus find_status(const FarmJob& job, bool decode);

/// "750 frames: 738 finished; missing: 12-23", in lines.
void print_status(const FarmStatus& status, std::ostream& out);

/// Joins the statistics of all tasks in the job's file, in the order of frames.
/// @throws OutputError
void join_statistics(const FarmJob& job, const FarmStatus& status);

}  // namespace aleph
