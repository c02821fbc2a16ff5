#include "tools/slurm_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <vector>

#include "tools/frame_list.h"
#include "tools/shell_word.h"

namespace tyndall::tools {
namespace {

// The name of the jobs and of their logs: that of the scene, of letters that mean nothing to Slurm.
std::string job_name(const Plan& plan) {
  std::string name = std::filesystem::path(plan.scene).stem().string();
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_' && c != '.'; }, '_');
  return name;
}

// What holds for all tasks, as lines that sbatch reads.
std::string directives(const SlurmOptions& options) {
  std::string text =
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --signal=B:USR1@60\n";
  if (!options.time.empty()) text += fmt::format("#SBATCH --time={}\n", options.time);
  if (options.memory) text += fmt::format("#SBATCH --mem={}K\n", *options.memory / 1024);
  if (!options.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", options.partition);
  return text;
}

// Slurm puts other words in the place of % and a letter.
std::string log_pattern(const SlurmOptions& options) {
  std::string folder;
  for (const char c : options.logs) folder += c == '%' ? std::string("%%") : std::string(1, c);
  return shell_word(folder + "/%x-%A_%a.log");
}

// What a task that renders asks for beside the directives, as words of the shell.
std::string render_resources(const SlurmOptions& options) {
  if (options.cpus) return fmt::format("--cpus-per-task={}", *options.cpus);
  return options.memory ? "--exclusive" : "--exclusive --mem=0";
}

// An array of the shell: name=(a b c).
std::string shell_array(std::string_view name, const Words& values) {
  std::string text = fmt::format("{}=(", name);
  std::size_t column = text.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string word = shell_word(values[i]);
    if (i > 0) text += column + word.size() > 110 ? (column = 2, "\n  ") : (++column, " ");
    text += word;
    column += word.size();
  }
  return text + ")\n";
}

// A word that is the shell's variable $frame stands unquoted in words that are quoted.
constexpr std::string_view frame_variable = "\"$frame\"";
std::string with_frame(const Words& words) {
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + (word == frame_variable ? word : shell_word(word));
  return line;
}

// The tasks: what `bash SCRIPT part1 FROM` and so on do on a machine of the cluster.
std::string tasks(const Plan& plan) {
  const std::string frame(frame_variable);
  std::string text =
      "\n# task NAME FROM: is the task of this name and of the array's index, counted from FROM.\n"
      "task() {\n"
      "  local frame=${frames[$2 + SLURM_ARRAY_TASK_ID]}\n"
      "  case $1 in\n";
  if (plan.parts.empty()) {
    Words words = frames_words(plan, {0});
    words[1] = frame;
    text += fmt::format("    frames) run \"${{render[@]}}\" {} ;;\n", with_frame(words));
  } else {
    for (std::size_t i = 0; i < plan.parts.size(); ++i)
      text += fmt::format("    part{}) run \"${{render[@]}}\" {} ;;\n", i + 1,
                          with_frame(part_words(plan, frame, i)));
    text += fmt::format("    merge) run {} ;;\n", with_frame(merge_words(plan, frame)));
  }
  return text +
         "  esac\n"
         "}\n"
         "case ${1:-} in frames | part* | merge) task \"$@\" ;; esac\n\n";
}

// Submits all arrays; an array has as many tasks as the cluster allows, and there may be several.
std::string submission(const Plan& plan, const SlurmOptions& options) {
  Words renders;
  for (std::size_t i = 0; i < plan.parts.size(); ++i) renders.push_back(fmt::format("part{}", i + 1));
  if (renders.empty()) renders.emplace_back("frames");
  std::string text = fmt::format(
      R"(most=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p')
: "${{most:=1001}}"
# submit TASK OPTION...: an array of one task for each frame from number $from to $last; prints its job's number
submit() {{
  local task=$1
  shift
  sbatch --parsable --array=0-$((last - from)) --job-name={0}-"$task" --output="$logs" "$@" "$script" "$task" "$from" |
    cut -d ';' -f 1
}}
mkdir -p {1} || exit
script=$0
logs={2}
for ((from = 0; from < ${{#frames[@]}}; from += most)); do
  last=$((from + most <= ${{#frames[@]}} ? from + most - 1 : ${{#frames[@]}} - 1))
  jobs=
  for task in {3}; do
    job=$(submit "$task" {4} "$@") && [[ $job ]] || exit 1
    jobs+=:$job
  done
)",
      job_name(plan), shell_word(options.logs), log_pattern(options), fmt::join(renders, " "),
      render_resources(options));
  if (!plan.parts.empty())
    text +=
        "  job=$(submit merge --cpus-per-task=1 --dependency=aftercorr\"$jobs\" \"$@\") && [[ $job ]] || "
        "exit 1\n"
        "  jobs+=:$job\n";
  return text +
         "  echo \"submitted as${jobs//:/ }\"\n"
         "done\n";
}

// Runs a command so that signals reach it.
constexpr std::string_view runner = R"(
# run COMMAND...: runs it as this task. Slurm sends USR1 to this shell a minute before the time limit: what has
# been rendered is then kept, and the task is queued again to go on from there. One that is killed is tried again
# three times. TERM, which Slurm sends to all processes, keeps what has been rendered, too, but queues nothing: it
# is a user's scancel, or the machine is wanted for other jobs, and then Slurm itself queues the task.
run() {
  local late= status
  "$@" &
  local task=$!
  trap 'late=1; kill -TERM "$task"' USR1
  trap : TERM
  while kill -0 "$task" 2>/dev/null; do wait "$task"; done
  wait "$task"
  status=$?
  if [[ $late && $status == 130 ]] || ((status == 137 && ${SLURM_RESTART_COUNT:-0} < 3)); then
    echo "ended with status $status, is queued again"
    scontrol requeue "$SLURM_JOB_ID"
  fi
  exit "$status"
}
)";

}  // namespace

std::string slurm_script(const Plan& plan, const SlurmOptions& options) {
  Words frames;
  for (const std::vector<int>& task : plan.frames) frames.push_back(frames_text(task));
  const std::size_t parts = plan.parts.size();
  std::string text = fmt::format(
      R"(#!/bin/bash
# Renders {} with Slurm: {} task{}{}. Made by Tyndall {}.
# Submit it, with options of sbatch if there are any to add:
#   bash THIS_FILE
# Submitted again, or run twice, it does no harm: what is there already is kept.
{}
)",
      plan.scene, frames.size() * std::max<std::size_t>(parts, 1), frames.size() == 1 && parts < 2 ? "" : "s",
      parts > 0 ? fmt::format(" of {} for each frame, and {} to merge them", parts, frames.size()) : "",
      TYNDALL_VERSION, directives(options));
  text += shell_array("frames", frames);
  text += shell_array("render", render_words(plan));
  text += runner;
  return text + tasks(plan) + submission(plan, options);
}

bool is_slurm_time(const std::string& text) {
  static const std::regex form(R"((\d{1,3}-)?(\d{1,6}(:[0-5]\d){0,2}))");
  std::smatch match;
  if (!std::regex_match(text, match, form)) return false;
  std::vector<long> numbers;
  const std::string clock = match[2];
  for (std::size_t at = 0; at <= clock.size(); at = std::min(clock.find(':', at), clock.size()) + 1)
    numbers.push_back(std::stol(clock.substr(at)));
  // With days the first number is hours; without, it is minutes unless there are three.
  const bool from_hours = match[1].matched || numbers.size() == 3;
  const long units[] = {from_hours ? 3600 : 60, from_hours ? 60 : 1, 1};
  long seconds = match[1].matched ? 86400 * std::stol(match[1]) : 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) seconds += units[i] * numbers[i];
  return seconds >= 180;
}

}  // namespace tyndall::tools
