#include "render/cli/farm/farm_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "engine/base/atomic_file.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr int seconds_to_stop = 60;  // between SIGTERM and the end of a task's time

std::string quote(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,+:") ==
                                            std::string::npos;
    if (plain) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

fs::path file_of(const FarmJob& job, const std::string& name, const std::string& ending) {
    return job.folder / fmt::format("{}.{}{}", name, job.rounds, ending);
}

void write_script(const fs::path& file, const std::string& text) {
    write_file(file, "#!/bin/bash\n" + text);
    std::error_code ignored;  // `bash FILE` works too
    fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add,
                    ignored);
}

/// The line that runs task $task, as the last of a script.
std::string task_command(const FarmJob& job, const std::string& program) {
    std::vector<std::string> words{program, job.command};
    words.insert(words.end(), job.arguments.begin(), job.arguments.end());
    words.insert(words.end(), {"-o", job.output});
    const std::string command = quote_words(words);
    if (job.command == "study") return command + " --shard \"$part\" -q";
    return fmt::format("{} --frames \"$part\" --stats {}.\"$task\".json --resume", command,
                       quote(file_of(job, "stats", "").string()));
}

/// Writes the list of what tasks do and the script of a task.
/// @param head  lines for the scheduler
fs::path write_task(const FarmJob& job, const std::vector<std::string>& parts, const std::string& head,
                    const std::string& program) {
    const fs::path list = file_of(job, "tasks", ".txt"), script = file_of(job, "task", ".sh");
    write_file(list, fmt::format("{}\n", fmt::join(parts, "\n")));
    write_script(
        script,
        head +
            fmt::format("# Runs one task: what its line of the list says; the first is 0. What is finished is kept.\n"
                        "cd {} || exit 1\n"
                        "task=${{1:-${{SLURM_ARRAY_TASK_ID:?give the number of a task}}}}\n"
                        "part=$(sed -n \"$((task + 1))p\" {})\n"
                        "[ -n \"$part\" ] || {{ echo \"there is no task $task\" >&2; exit 2; }}\n"
                        "exec {}\n",
                        quote(job.working.string()), quote(list.string()), task_command(job, program)));
    return script;
}

/// Slurm replaces % and what follows in names of logs, and takes %% for a %.
std::string in_slurm_pattern(const fs::path& file) {
    std::string text;
    for (const char c : file.string()) text += c == '%' ? "%%" : std::string(1, c);
    return text;
}

std::string slurm_head(const FarmJob& job, std::size_t tasks) {
    const FarmResources& resources = job.resources;
    std::string head;
    const auto add = [&](const std::string& option) { head += "#SBATCH " + option + "\n"; };
    add(fmt::format("--job-name=aleph-{}", job.command));
    add(fmt::format("--array=0-{}", tasks - 1));
    if (!resources.time.empty()) add("--time=" + resources.time);
    if (!resources.partition.empty()) add("--partition=" + resources.partition);
    if (!resources.memory.empty()) add("--mem=" + resources.memory);
    if (resources.cpus > 0) add(fmt::format("--cpus-per-task={}", resources.cpus));
    add("--requeue");
    add("--open-mode=append");
    add(fmt::format("--signal=B:TERM@{}", seconds_to_stop));
    add(fmt::format("--output=\"{}-%a.log\"", in_slurm_pattern(file_of(job, "task", ""))));
    return head;
}

/// afterany: a task that was requeued after exit code 75 counts as failed for afterok, whatever it ends with.
std::string submit_to_slurm(const FarmJob& job, const fs::path& task, std::size_t parts, const std::string& program) {
    const fs::path collate = file_of(job, "collate", ".sh");
    const FarmResources& resources = job.resources;
    std::string options;
    if (!resources.partition.empty()) options += " --partition=" + quote(resources.partition);
    if (!resources.memory.empty()) options += " --mem=" + quote(resources.memory);
    write_script(collate, fmt::format("cd {} || exit 1\nexec {}\n", quote(job.working.string()),
                                      quote_words({program, "farm", "collate", job.folder.string()})));
    return fmt::format(
        "set -eu\n"
        "tasks=$(sbatch --parsable {})\n"
        "collate=$(sbatch --parsable --dependency=afterany:\"$tasks\"{} --output={} {})\n"
        "echo \"submitted {} tasks as job $tasks, and job $collate, which collates them\"\n",
        quote(task.string()), options, quote(in_slurm_pattern(file_of(job, "collate", ".log"))),
        quote(collate.string()), parts);
}

std::string submit_to_parallel(const FarmJob& job, const fs::path& task, std::size_t parts,
                               const std::string& program) {
    const FarmResources& resources = job.resources;
    std::vector<std::string> words{
        "parallel", "--joblog", file_of(job, "jobs", ".txt").string(), "--resume-failed", "--retries",
        "3",        "--jobs",   fmt::format("{}", resources.jobs)};
    if (!resources.hosts.empty()) {
        words.insert(words.end(), {"--sshlogin", fmt::format("{}", fmt::join(resources.hosts, ","))});
        words.insert(words.end(), {"--workdir", job.working.string()});
    }
    words.insert(words.end(), {"--quote", "bash", task.string()});
    return fmt::format("cd {} || exit 1\n{} ::: $(seq 0 {}) || true\nexec {}\n", quote(job.working.string()),
                       quote_words(words), parts - 1, quote_words({program, "farm", "collate", job.folder.string()}));
}

}  // namespace

std::string quote_words(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + quote(word);
    return line;
}

fs::path write_farm_scripts(FarmJob& job, const std::vector<std::string>& parts, const std::string& program) {
    ++job.rounds;
    write_farm_job(job);
    const bool slurm = job.scheduler == "slurm";
    const fs::path submit = file_of(job, "submit", ".sh");
    const fs::path task = write_task(job, parts, slurm ? slurm_head(job, parts.size()) : "", program);
    const auto submit_to = slurm ? submit_to_slurm : submit_to_parallel;
    write_script(submit, submit_to(job, task, parts.size(), program));
    return submit;
}

}  // namespace aleph
