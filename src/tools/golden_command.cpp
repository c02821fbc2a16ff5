// `tyndall golden`: scenes are rendered and compared with the pictures beside them.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>

#include "base/parallel.h"
#include "image/files.h"
#include "tools/commands.h"
#include "tools/comparison.h"
#include "tools/files_in_use.h"
#include "tools/golden.h"
#include "tools/interrupt.h"
#include "tools/numbers.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

namespace fs = std::filesystem;

// A folder of its own for pictures on the way, removed at the end. It is locked meanwhile, so that those of
// runs which were killed can be told, and are removed by the next one.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code failed;
    const fs::path all = fs::temp_directory_path(failed);
    if (failed) return;
    remove_abandoned(all);
    std::string pattern = (all / (std::string(prefix) + "XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) return;
    path_ = pattern;
    lock_ = locked(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }  // empty: there is none

 private:
  static constexpr std::string_view prefix = "tyndall-golden-";

  // A file that holds the lock; -1 where another process has it.
  static int locked(const fs::path& folder) {
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    ::close(file);
    return -1;
  }
  // One that was made just now may not be locked yet.
  static void remove_abandoned(const fs::path& all) {
    constexpr auto enough = std::chrono::minutes(1);
    std::error_code ignored;
    for (fs::directory_iterator at(all, ignored), end; !ignored && at != end; at.increment(ignored)) {
      if (!at->path().filename().string().starts_with(prefix)) continue;
      std::error_code unknown;
      const auto changed = fs::last_write_time(at->path(), unknown);
      if (unknown || fs::file_time_type::clock::now() - changed < enough) continue;
      const int lock = locked(at->path());
      if (lock < 0) continue;
      fs::remove_all(at->path(), unknown);
      ::close(lock);
    }
  }

  std::string path_;
  int lock_ = -1;
};

std::string line_of(const GoldenResult& result) {
  std::string text = fmt::format("{:<9} {}: {}\n", name(result.outcome), result.golden.scene, result.message);
  for (const std::string& note : result.notes) text += fmt::format("          {}\n", note);
  return text;
}

// Prints each result as soon as those before it are there.
class InOrder {
 public:
  InOrder(std::vector<std::optional<GoldenResult>>& results, bool quiet) : results_(results), quiet_(quiet) {}

  void put(std::size_t index, GoldenResult result) {
    const std::lock_guard lock(mutex_);
    results_[index] = std::move(result);
    for (; next_ < results_.size() && results_[next_]; ++next_)
      if (!quiet_) print_result(line_of(*results_[next_]));
    if (!quiet_) std::fflush(stdout);
  }

 private:
  std::vector<std::optional<GoldenResult>>& results_;
  bool quiet_;
  std::mutex mutex_;
  std::size_t next_ = 0;
};

// As many scenes at a time as there are threads; where there are fewer scenes, each gets several. Those that
// an interruption left out are a problem, so that no report looks as if all had been tested.
std::vector<GoldenResult> run_all(const GoldenArguments& arguments, const std::vector<GoldenScene>& scenes,
                                  const std::string& directory) {
  const std::atomic<bool>& interrupted = catch_interrupts();
  const int threads = arguments.threads > 0 ? arguments.threads : hardware_threads();
  const int at_a_time = std::min(threads, static_cast<int>(scenes.size()));
  std::vector<std::optional<GoldenResult>> found(scenes.size());
  InOrder printer(found, arguments.json);
  parallel_for(scenes.size(), at_a_time, [&](std::size_t i, int) {
    if (interrupted) return;
    GoldenResult result = run_golden(arguments, scenes[i], directory, i, threads / at_a_time);
    if (!interrupted) printer.put(i, std::move(result));
  });
  std::vector<GoldenResult> results;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) {
      GoldenResult& result = found[i].emplace();
      result.golden = scenes[i];
      result.tested = false;
      result.message = "it was not tested, for an interruption came before";
    }
    results.push_back(std::move(*found[i]));
  }
  return results;
}

std::size_t count(const std::vector<GoldenResult>& results, GoldenOutcome outcome) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [outcome](const GoldenResult& r) { return r.outcome == outcome; }));
}

// "3 passed, 1 differs".
std::string summary(const std::vector<GoldenResult>& results) {
  std::string text;
  for (const GoldenOutcome outcome : {GoldenOutcome::passed, GoldenOutcome::unchanged, GoldenOutcome::created,
                                      GoldenOutcome::changed, GoldenOutcome::differs, GoldenOutcome::problem})
    if (const std::size_t n = count(results, outcome); n > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name(outcome));
  return text;
}

nlohmann::json json_of(const GoldenResult& result) {
  nlohmann::json json{{"scene", result.golden.scene},    {"reference", result.golden.reference},
                      {"outcome", name(result.outcome)}, {"message", result.message},
                      {"notes", result.notes},           {"seconds", result.seconds}};
  if (result.relative_mse) json["relmse"] = *result.relative_mse;
  if (result.flip) json["flip"] = *result.flip;
  if (result.z_test) json["z_test"] = to_json(*result.z_test);
  return json;
}

std::string write_text(const std::string& path, const std::string& text) {
  return path.empty() ? std::string() : image::write_file_whole(path, std::as_bytes(std::span(text)));
}

ExitStatus tell(const GoldenArguments& arguments, const std::vector<GoldenResult>& results,
                const std::string& machine) {
  if (arguments.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const GoldenResult& result : results) list.push_back(json_of(result));
    print_json({{"machine", machine}, {"results", list}});
  } else {
    print_result(fmt::format("{}\n", summary(results)));
  }
  bool written = true;
  for (const auto& [path, text] :
       {std::pair(arguments.report, arguments.report.empty() ? "" : golden_html(arguments, results, machine)),
        {arguments.junit, arguments.junit.empty() ? "" : golden_junit(results, machine)}})
    if (const std::string problem = write_text(path, text); !problem.empty()) {
      print_error(problem);
      written = false;
    }
  const std::size_t problems = count(results, GoldenOutcome::problem),
                    differing = count(results, GoldenOutcome::differs);
  if (differing > 0 && arguments.report.empty())
    print_error(fmt::format("{} {}: --report PAGE.html shows the pictures, --update accepts them as they are",
                            differing, differing == 1 ? "picture differs" : "pictures differ"));
  if (problems > 0 || !written) return ExitStatus::problem;
  return differing > 0 ? ExitStatus::test_failed : ExitStatus::done;
}

// No report may be one of the files that are tested.
std::string outputs_problem(const GoldenArguments& arguments, const std::vector<GoldenScene>& scenes) {
  FilesInUse files;
  for (const GoldenScene& golden : scenes)
    for (const std::string& path : {golden.scene, golden.reference})
      if (std::string problem = files.read(path, "the file"); !problem.empty()) return problem;
  for (const auto& [path, option] : {std::pair(arguments.report, "--report"), {arguments.junit, "--junit"}}) {
    if (path.empty()) continue;
    if (std::string problem = image::check_file_writable(path); !problem.empty()) return problem;
    if (std::string problem = files.write(path, option); !problem.empty()) return problem;
  }
  return {};
}

ExitStatus fail_golden(const std::string& message) { return print_error(message), ExitStatus::problem; }

ExitStatus run_golden_tests(const GoldenArguments& arguments) {
  if (arguments.seed && !arguments.statistical)
    return misuse("--seed wants --statistical: without it pictures are compared at the reference's seed");
  if (arguments.update && arguments.statistical)
    return misuse("--update renders references with their own seed: leave out --statistical");
  if (arguments.max && (arguments.statistical || arguments.update))
    return misuse("--max limits the difference of pixels: leave it out with --statistical and --update");
  if (std::error_code ignored;
      !arguments.references.empty() && !fs::is_directory(arguments.references, ignored))
    return fail_golden(fmt::format("--references wants a folder, and '{}' is none", arguments.references));
  const GoldenScenes found = find_golden_scenes(arguments.paths, arguments.references);
  if (!found.problem.empty()) return fail_golden(found.problem);
  if (const std::string problem = outputs_problem(arguments, found.scenes); !problem.empty())
    return fail_golden(problem);
  const ScratchFolder scratch;
  if (scratch.path().empty())
    return fail_golden(
        "there is no room for pictures on the way: set TMPDIR to a folder that can be written");
  const std::string machine = describe_machine(arguments.threads);
  if (!arguments.json) print_result(fmt::format("{}\n", machine));
  const std::vector<GoldenResult> results = run_all(arguments, found.scenes, scratch.path());
  const ExitStatus status = tell(arguments, results, machine);
  const auto untested = std::count_if(results.begin(), results.end(),
                                      [](const GoldenResult& result) { return !result.tested; });
  if (untested == 0) return status;
  print_error(fmt::format("interrupted: {} of {} scenes were not tested", untested, results.size()));
  return ExitStatus::interrupted;
}

Action golden_options(CLI::App& command) {
  const auto arguments = std::make_shared<GoldenArguments>();
  command
      .add_option("paths", arguments->paths,
                  "Folders of scenes, or scenes, each with its reference beside it: fog.tyn and fog.exr")
      ->required()
      ->option_text("DIR...");
  command.add_flag("--statistical", arguments->statistical,
                   "Render with another seed, and compare by z-tests what should be the same light");
  add_whole(command, "--seed", arguments->seed,
            "With --statistical: the seed; without it, the one after the reference's");
  add_real(command, "--max", arguments->max,
           "Let pictures pass whose relmse is at most this; without it they must be equal");
  command
      .add_option("--references", arguments->references,
                  "The folder of the references; without it, each is beside its scene")
      ->option_text("DIR");
  command.add_flag("--update", arguments->update, "Render the references, and tell what has changed");
  command
      .add_option("--report", arguments->report,
                  "Write a page that shows the results, with pictures of what did not pass")
      ->option_text("PAGE.html");
  command.add_option("--junit", arguments->junit, "Write the results as JUnit's XML, for CI systems")
      ->option_text("OUT.xml");
  command
      .add_option("--include", arguments->include_directories,
                  "A folder in which included files are looked for; may be repeated")
      ->option_text("DIR")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->expected(1);
  command.add_flag("--allow-outside", arguments->allow_outside,
                   "Let scenes name files outside of their folder and those of --include");
  add_whole(command, "--threads", arguments->threads,
            "Number of threads, for scenes that are rendered side by side");
  command.add_flag("--json", arguments->json, "Print the results as JSON on standard output");
  return [arguments] { return run_golden_tests(*arguments); };
}

}  // namespace

constinit const Command golden_command{"golden", "Render scenes and compare them with their references",
                                       golden_options};

}  // namespace tyndall::tools
