#pragma once
// The scripts of a job's tasks, for Slurm and for GNU parallel.

#include <filesystem>
#include <string>
#include <vector>

#include "render/cli/farm/farm_job.h"

namespace aleph {

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

}  // namespace aleph
