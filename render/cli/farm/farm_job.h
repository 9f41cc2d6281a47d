#pragma once
// Frames or a study divided into tasks for a scheduler: what the tasks are, kept in a folder `farm` beside the results;
// their scripts, for Slurm and for GNU parallel; and which frames are finished, missing, damaged or of something else.

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "render/cli/scene_options.h"
#include "render/frame/frame_output.h"

namespace aleph {

/// A request to a scheduler. Empty texts and 0: its own defaults.
struct FarmResources {
    std::string time, partition, memory;  ///< as Slurm reads them
    int cpus = 0;                         ///< of each task
    std::vector<std::string> hosts;       ///< of GNU parallel; none: this one
    int jobs = 1;                         ///< tasks of GNU parallel at a time on each host
};

struct FarmJob {
    std::string scheduler;  ///< slurm or parallel
    FarmResources resources;
    int tasks = 1;                       ///< at most, in a round
    std::string command;                 ///< render, maps or study
    std::vector<std::string> arguments;  ///< of the command, without frames, --output, --stats and --resume
    std::string frames;                  ///< a list of all frames; of a study: empty
    std::string output;                  ///< --output
    std::string stats;                   ///< that collate writes; may be empty
    std::filesystem::path folder;        ///< of the job, absolute
    std::filesystem::path working;       ///< the folder in which tasks run
    int rounds = 0;                      ///< how often tasks were written and submitted
};

/// A command that makes frames, as its words say.
struct FrameCommand {
    SceneOptions options;
    FrameRequest request;
    std::string cache;
};

/// The command for all frames of a job.
/// @throws CLI::ParseError, InputError
FrameCommand parse_frame_command(const FarmJob& job);

/// The frames of a task each, contiguous and of about equal number: all of the frames in their order.
std::vector<std::string> divide_frames(const std::vector<int>& frames, int tasks);

/// Writes `job.json` into the job's folder.
/// @throws OutputError
void write_farm_job(const FarmJob& job);

/// Returns whether two jobs have the same results, whatever their tasks and scheduler: one may be a round of the other.
bool makes_the_same(const FarmJob& a, const FarmJob& b);

/// Reads the job of a folder of results, or of the folder `farm` in it.
/// @throws InputError
FarmJob read_farm_job(const std::filesystem::path& folder);

/// Words as one shell command.
std::string quote_words(const std::vector<std::string>& words);

/// Writes the next round of a job's tasks: a list of what each is to do, the script that runs one of them, and the
/// script that submits all of them and then collates. Adds 1 to the job's rounds, and writes the job.
/// @param parts    what each task is to do: a list of frames, or a part of a study such as 3/8
/// @param program  path of `aleph`
/// @return the script that submits
/// @throws OutputError
std::filesystem::path write_farm_scripts(FarmJob& job, const std::vector<std::string>& parts,
                                         const std::string& program);

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
