// The scenes of tests/extremes: numbers at the ends of their ranges and beyond. Each names its cases in its
// head, a line each:
//
//   // case: OPTIONS | truth X | within Y % | says 'TEXT'
//
// The scene is rendered with those options. The mean of its picture is to be the truth, up to four standard
// errors and what `within` allows of it, and what the program says is to hold the text. A case without a
// truth may have no picture.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace tyndall::support {

struct ExtremeCase {
  std::filesystem::path scene;
  std::string options;
  std::optional<double> truth{};
  double within = 0;  // share of the truth that the mean may be off besides its noise
  std::string says{};
};

struct ExtremeOutcome {
  int status = -1;
  std::string said{};
  double cpu_seconds = 0;
  std::optional<double> peak_bytes{};  // as the program tells it of itself
  std::optional<double> mean{};        // of the picture, over its channels too
  double standard_error = 0;
  std::string fault{};  // empty when all is as the case says
};

inline std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos
             ? std::string()
             : std::string(text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin));
}

// A line's part of a case; throws where it is none.
inline void read_part(const std::string& part, ExtremeCase& one) {
  if (part.starts_with("truth "))
    one.truth = std::stod(part.substr(6));
  else if (part.starts_with("within ") && part.ends_with(" %"))
    one.within = std::stod(part.substr(7)) / 100;
  else if (part.starts_with("says '") && part.ends_with("'") && part.size() > 7)
    one.says = part.substr(6, part.size() - 7);
  else
    throw std::runtime_error("not a part of a case: " + part);
}

inline std::vector<ExtremeCase> cases_of(const std::filesystem::path& scene) {
  constexpr std::string_view mark = "// case:";
  std::vector<ExtremeCase> cases;
  std::ifstream file(scene);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(mark)) continue;
    std::istringstream parts(line.substr(mark.size()));
    ExtremeCase one{scene, {}};
    std::string part;
    std::getline(parts, part, '|');
    one.options = trimmed(part);
    while (std::getline(parts, part, '|')) read_part(trimmed(part), one);
    if (!one.truth && one.says.empty()) throw std::runtime_error("a case that says nothing: " + line);
    cases.push_back(std::move(one));
  }
  return cases;
}

// The scenes, by name.
inline std::vector<std::filesystem::path> extreme_scenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(TYNDALL_SOURCE_DIR) / "tests/extremes"))
    if (entry.path().extension() == ".tyn") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

struct RowSums {
  double sum = 0;
  std::size_t lit = 0;  // numbers that are not 0
};
class SummedRows final : public image::RowTaker {
 public:
  std::string begin(const image::PictureHeader& header) override {
    return header.chosen.empty() ? "no such channel" : std::string();
  }
  void row(std::span<const float> numbers) override {
    for (const float number : numbers) sums.sum += static_cast<double>(number), sums.lit += number != 0;
  }
  RowSums sums{};
};

// Over a channel, or the colours, of a picture.
inline RowSums row_sums(const std::string& picture, const std::string& channel) {
  SummedRows rows;
  if (const std::string problem = image::read_rows(picture, channel, std::nullopt, rows); !problem.empty())
    throw std::runtime_error(problem);
  return rows.sums;
}

// The mean over the pixels that have samples: others are outside of a crop. The noise of a pixel's colours
// may be the same, so their variances are not divided by their number.
inline void read_mean(const std::string& picture, ExtremeOutcome& out) {
  const auto pixels = static_cast<double>(row_sums(picture, "samples").lit);
  double variance = 0;
  for (const char* channel : {"variance.R", "variance.G", "variance.B"})
    variance += row_sums(picture, channel).sum / 3;
  out.mean = row_sums(picture, "").sum / (3 * pixels);
  out.standard_error = std::sqrt(variance) / pixels;
}

// Runs the program with its output in a file.
inline void run_quietly(const std::vector<std::string>& command, const std::string& log,
                        ExtremeOutcome& out) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) != child) throw std::runtime_error("the process is lost");
  out.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  out.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  std::ifstream file(log);
  out.said.assign(std::istreambuf_iterator<char>(file), {});
}

// Of the statistics that the program writes. What the system tells of a process counts the one that started
// it.
inline std::optional<double> peak_bytes_in(const std::filesystem::path& statistics) {
  std::ifstream file(statistics);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string_view name = "\"peak_memory_bytes\":";
  const std::size_t at = text.find(name);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(text.substr(at + name.size()));
}

// What is not as the case says; empty: nothing.
inline std::string fault_of(const ExtremeCase& one, const ExtremeOutcome& out) {
  // 1: it explains; 2: misuse of the command line, which is explained likewise.
  if (out.status > 2) return fmt::format("ended with status {}", out.status);
  if (out.said.find(one.says) == std::string::npos) return fmt::format("does not say '{}'", one.says);
  if (!one.truth) return {};
  if (!out.mean) return "made no picture";
  // A standard error that is large would pass anything.
  if (!(out.standard_error <= std::max(0.03, one.within) * std::abs(*one.truth)))
    return "is too noisy to tell";
  const double error = std::abs(*out.mean - *one.truth);
  if (!(error <= 4 * out.standard_error + one.within * std::abs(*one.truth)))
    return fmt::format("is off by {:.3g}", error);
  return {};
}

// Renders a case into `folder`, which is to be there.
inline ExtremeOutcome render_extreme(const ExtremeCase& one, const std::filesystem::path& folder) {
  const std::string picture = (folder / "out.exr").string();
  const std::filesystem::path statistics = folder / "out.json";
  for (const std::filesystem::path& old : {std::filesystem::path(picture), statistics})
    std::filesystem::remove(old);
  std::vector<std::string> command{TYNDALL_PROGRAM,    "render",  one.scene.string(), "-o", picture, "--aov",
                                   "variance,samples", "--stats", statistics.string()};
  std::istringstream options(one.options);
  command.insert(command.end(), std::istream_iterator<std::string>(options), {});
  ExtremeOutcome out;
  run_quietly(command, (folder / "said.txt").string(), out);
  out.peak_bytes = peak_bytes_in(statistics);
  if (std::filesystem::exists(picture)) read_mean(picture, out);
  out.fault = fault_of(one, out);
  return out;
}

}  // namespace tyndall::support
