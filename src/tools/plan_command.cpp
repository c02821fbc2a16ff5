// `tyndall plan`: the frames of a scene as tasks of a farm.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "tools/commands.h"
#include "tools/frame_list.h"
#include "tools/numbers.h"
#include "tools/part_facts.h"
#include "tools/plan.h"
#include "tools/plan_checks.h"
#include "tools/render_checks.h"
#include "tools/report.h"
#include "tools/sequence_checks.h"
#include "tools/slurm_script.h"

namespace tyndall::tools {
namespace {

namespace fs = std::filesystem;

struct PlanArguments {
  RenderArguments render;
  int split = 1;
  std::optional<int> chunk;  // frames of a task
  std::string program;       // empty: this one
  bool slurm = false;
  SlurmOptions options;
  Words passed;  // options of render that each task has
};

// Options of render that have no place in a plan, and why.
struct Refusal {
  std::string_view option, why;
};
constexpr Refusal refusals[] = {
    {"--pixel", "it writes no picture"},
    {"--sample", "it writes no picture"},
    {"--part-of", "--split does that"},
    {"--json", "its output goes to the log of a task: give --stats 'FILE.####.json'"},
    {"--movie", "no task has all frames: render the same frames with --movie when they are there"},
    {"--overwrite", "a task that is run again would begin anew: remove the frames instead"},
};
// Options of render that a plan gives each task for itself.
constexpr std::string_view of_tasks[] = {"--output", "--frame", "--frames", "--resume"};

std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

std::string own_program() {
  std::error_code failed;
  const fs::path path = fs::read_symlink("/proc/self/exe", failed);
  return failed ? "tyndall" : path.string();
}

// Its long name, "--samples", whether the help lists it or not; empty: it has none.
std::string long_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? std::string() : "--" + option.get_lnames().front();
}

// The options of render that were given, as words, with paths that hold in any folder.
Words passed_words(const std::vector<const CLI::Option*>& options) {
  Words words;
  for (const CLI::Option* option : options) {
    const std::string name = long_name(*option);
    if (option->count() == 0 || name.empty() || std::ranges::count(of_tasks, name)) continue;
    const bool is_path = name == "--include" || name == "--stats";
    for (const std::string& text : option->reduced_results()) {
      words.push_back(name);
      if (option->get_items_expected_max() == 0) break;
      words.push_back(is_path ? absolute(text) : text);
    }
  }
  return words;
}

bool was_given(const std::vector<const CLI::Option*>& options, std::string_view name) {
  return std::ranges::any_of(
      options, [&](const CLI::Option* option) { return long_name(*option) == name && option->count() > 0; });
}

// What of the command line does not go together, before the scene is read.
std::string usage_problem_of(const PlanArguments& arguments) {
  const RenderArguments& render = arguments.render;
  if (render.output.empty()) return "plan wants the pictures to write: -o 'out.####.exr'";
  if (std::string problem = usage_problem(render); !problem.empty()) return problem;
  if (arguments.split > 1) {
    for (const auto& [is_given, option, why] :
         {std::tuple(render.error.has_value(), "--error", "parts have the same samples of all pixels"),
          std::tuple(render.time_limit.has_value(), "--time-limit",
                     "parts have the same samples of all pixels"),
          std::tuple(render.sample_range.has_value(), "--sample-range", "it splits all samples itself"),
          std::tuple(!render.statistics_file.empty(), "--stats", "all parts would write the same file")})
      if (is_given) return fmt::format("{} does not go with --split: {}", option, why);
    if (is_part(render.output))
      return fmt::format("--split wants a picture to merge, such as .exr or .png, not '{}'", render.output);
  }
  const auto has_break = [](const std::string& text) { return text.find('\n') != std::string::npos; };
  for (const Words& words : {arguments.passed, Words{render.scene.path, render.output, arguments.program}})
    if (const auto found = std::ranges::find_if(words, has_break); found != words.end())
      return fmt::format("a plan has one command a line, and there is a line break in '{}'", *found);
  return {};
}

Plan plan_of(const PlanArguments& arguments, const PlannedFrames& frames) {
  Plan plan;
  const std::string& program = arguments.program;
  plan.program = program.empty()                          ? own_program()
                 : program.find('/') == std::string::npos ? program
                                                          : absolute(program);
  plan.scene = absolute(arguments.render.scene.path);
  plan.options = arguments.passed;
  plan.output = absolute(arguments.render.output);
  if (arguments.split > 1) plan.parts = split_samples(frames.samples, arguments.split);
  plan.frames = in_chunks(frames.numbers, static_cast<std::size_t>(arguments.chunk.value_or(1)));
  return plan;
}

ExitStatus run_plan(PlanArguments arguments) {
  if (const std::string problem = usage_problem_of(arguments); !problem.empty()) return misuse(problem);
  PlannedFrames frames;
  if (const ExitStatus status = check_frames(arguments.render, arguments.split, frames);
      status != ExitStatus::done)
    return status;
  const Plan plan = plan_of(arguments, frames);
  SlurmOptions& options = arguments.options;
  options.logs =
      absolute(options.logs.empty() ? (fs::path(plan.output).parent_path() / "logs").string() : options.logs);
  print_result(arguments.slurm ? slurm_script(plan, options) : plan_lines(plan));
  return ExitStatus::done;
}

void add_slurm_options(CLI::App& command, PlanArguments& arguments) {
  CLI::Option* slurm = command.add_flag("--slurm", arguments.slurm,
                                        "Write a script that submits itself to Slurm, in place of commands");
  SlurmOptions& options = arguments.options;
  const auto add = [&](CLI::Option* option) { option->needs(slurm); };
  add(add_text_option(
      command, "--time", "TIME",
      "Limit of a task's time, as minutes or [D-]HH:MM:SS; what is not done by then goes on in another run",
      [&options](const std::string& text) {
        if (!is_slurm_time(text))
          refuse("--time", "minutes or [D-]HH:MM:SS, from 3 minutes on, for instance 90 or 12:00:00", text);
        options.time = text;
      }));
  add(add_text_option(command, "--memory", "SIZE", "Memory of a task, for instance 8GB",
                      [&options](const std::string& text) {
                        options.memory = read_bytes(text);
                        if (!options.memory)
                          refuse("--memory", "a size from 16MB to 1TB, for instance 512MB or 8GB", text);
                      }));
  add(add_whole(command, "--cpus", options.cpus,
                "Processors of a task; without it, a machine for each task"));
  add(add_text_option(command, "--partition", "NAME", "The partition of the cluster",
                      [&options](const std::string& text) {
                        if (text.find_first_of(" \t\n\"'\\#") != std::string::npos)
                          refuse("--partition", "a name, or several between commas", text);
                        options.partition = text;
                      }));
  add(command
          .add_option("--logs", options.logs,
                      "The folder of what tasks print; without it, `logs` beside the pictures")
          ->option_text("DIR"));
}

Action plan_options(CLI::App& command) {
  const auto arguments = std::make_shared<PlanArguments>();
  add_render_options(command, arguments->render);
  const CLI::App& added = command;
  const std::vector<const CLI::Option*> of_render = added.get_options();
  for (const auto& [option, why] : refusals) command.get_option(std::string(option))->group("");
  CLI::Option* split = add_whole(command, "--split", arguments->split,
                                 "Render each frame in so many parts, by samples, and merge them");
  add_whole(command, "--chunk", arguments->chunk, "Frames of a task")->excludes(split);
  command
      .add_option("--program", arguments->program,
                  "What the machines of the farm call the program; without it, the path of this one")
      ->option_text("PATH");
  add_slurm_options(command, *arguments);
  return [arguments, of_render] {
    for (const auto& [option, why] : refusals)
      if (was_given(of_render, option))
        return misuse(fmt::format("{} does not go with plan: {}", option, why));
    arguments->passed = passed_words(of_render);
    if (arguments->options.cpus && arguments->render.threads == 0)
      for (const std::string& word : {std::string("--threads"), fmt::format("{}", *arguments->options.cpus)})
        arguments->passed.push_back(word);
    return run_plan(*arguments);
  };
}

}  // namespace

constinit const Command plan_command{"plan", "Print the commands that render frames on a farm", plan_options};

}  // namespace tyndall::tools
