// What was measured, kept in a file to which each render is appended: so that a measurement goes on after
// whatever ended it, and with more values or seeds.
//
// The file is a line of JSON that says what scene it is of, then for each render a line of JSON and the
// picture: R, G, B of each pixel, in 32-bit floats of this machine.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/measure/render_run.h"

namespace tyndall::tools {

struct MeasuredRun {
  std::string key;  // of the setting, or of the reference
  std::uint64_t seed = 0;
  int samples = 0;          // a pixel
  int part = 0, round = 0;  // of the reference
  RunCost cost{};
  std::int64_t place = 0;  // of its picture in the file
};

class Measurements {
 public:
  // Opens the file of the path, or one that vanishes with this object where the path is empty. What is there
  // of the same scene is read; a file of another scene, version or size is replaced, and replaced() says why.
  Measurements(const std::string& path, const nlohmann::json& scene, std::size_t values_per_picture);

  const std::string& problem() const { return problem_; }
  const std::string& replaced() const { return replaced_; }
  const std::vector<MeasuredRun>& runs() const { return runs_; }
  std::vector<MeasuredRun> runs_of(const std::string& key) const;

  // Gives an error message, or an empty string.
  std::string add(MeasuredRun run, const std::vector<float>& pixels);
  std::vector<float> pixels(const MeasuredRun& run) const;

 private:
  struct Closes {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void read_runs(const nlohmann::json& scene);
  void begin_anew(const nlohmann::json& scene);
  bool read_line(std::string& line);

  std::string path_, problem_, replaced_;
  std::size_t values_;
  std::unique_ptr<std::FILE, Closes> file_;
  std::vector<MeasuredRun> runs_;
  std::int64_t end_ = 0;  // of the last render that is whole
};

}  // namespace tyndall::tools
