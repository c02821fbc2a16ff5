// A plan as a script that submits itself to Slurm (slurm.schedmd.com) as job arrays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tools/plan.h"

namespace tyndall::tools {

struct SlurmOptions {
  std::string time;                     // limit of a task, as sbatch takes it; empty: the partition's
  std::optional<std::uint64_t> memory;  // of a task [bytes]
  std::optional<int> cpus;              // of a task; nothing: all of a machine
  std::string partition;                // empty: the default one
  std::string logs;                     // the folder of the tasks' output, an absolute path
};

// The script. One array a part number, so that the merge of a frame waits for the tasks of its own index
// alone.
std::string slurm_script(const Plan& plan, const SlurmOptions& options);

// Whether a text is a limit of time as sbatch takes it, of three minutes or more: "90" (minutes), "12:00:00",
// "2-12:00:00".
bool is_slurm_time(const std::string& text);

}  // namespace tyndall::tools
