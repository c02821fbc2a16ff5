#include "tools/measure/measurements.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

namespace tyndall::tools {
namespace {

constexpr const char* kind_entry = "tyndall_measurements";
constexpr int file_version = 1;  // of the file

nlohmann::json to_json(const MeasuredRun& run) {
  return {{"key", run.key},
          {"seed", run.seed},
          {"samples", run.samples},
          {"part", run.part},
          {"round", run.round},
          {"seconds", run.cost.seconds},
          {"cpu_seconds", run.cost.cpu_seconds},
          {"preparation", run.cost.preparation_cpu_seconds},
          {"peak_bytes", run.cost.peak_bytes}};
}

MeasuredRun run_from(const nlohmann::json& json) {
  MeasuredRun run;
  json.at("key").get_to(run.key);
  json.at("seed").get_to(run.seed);
  json.at("samples").get_to(run.samples);
  json.at("part").get_to(run.part);
  json.at("round").get_to(run.round);
  run.cost = {json.at("seconds"), json.at("cpu_seconds"), json.at("preparation"), json.at("peak_bytes")};
  return run;
}

std::string line_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

// What differs between two scenes, by the names of the entries.
std::string differences(const nlohmann::json& there, const nlohmann::json& wanted) {
  std::string names;
  for (const auto& [name, value] : wanted.items())
    if (!there.contains(name) || there.at(name) != value) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

Measurements::Measurements(const std::string& path, const nlohmann::json& scene,
                           std::size_t values_per_picture)
    : path_(path), values_(values_per_picture) {
  if (path.empty()) {
    file_.reset(std::tmpfile());
  } else {
    file_.reset(std::fopen(path.c_str(), "r+b"));
    if (file_) {
      read_runs(scene);
      return;
    }
    file_.reset(std::fopen(path.c_str(), "w+b"));
  }
  if (!file_)
    problem_ =
        fmt::format("cannot write '{}': {}", path.empty() ? "a temporary file" : path, std::strerror(errno));
  else
    begin_anew(scene);
}

void Measurements::begin_anew(const nlohmann::json& scene) {
  nlohmann::json head = scene;
  head[kind_entry] = file_version;
  const std::string line = line_of(head);
  runs_.clear();
  std::rewind(file_.get());
  if (::ftruncate(::fileno(file_.get()), 0) != 0 ||
      std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    problem_ = fmt::format("cannot write '{}': {}", path_, std::strerror(errno));
  end_ = static_cast<std::int64_t>(line.size());
}

bool Measurements::read_line(std::string& line) {
  line.clear();
  for (int c = std::fgetc(file_.get()); c != EOF; c = std::fgetc(file_.get())) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
    if (line.size() > 1'000'000) return false;
  }
  return false;
}

void Measurements::read_runs(const nlohmann::json& scene) {
  std::string line;
  if (!read_line(line) && line.empty()) return begin_anew(scene);
  const nlohmann::json head = nlohmann::json::parse(line, nullptr, false);
  if (!head.is_object() || !head.contains(kind_entry)) {
    problem_ = fmt::format(
        "'{}' is no file of measurements, and is left as it is: name another one, --keep FILE", path_);
    return;
  }
  replaced_ = head.at(kind_entry) == file_version ? differences(head, scene) : "the kind of the file";
  if (!replaced_.empty()) return begin_anew(scene);
  end_ = std::ftell(file_.get());
  const auto bytes = static_cast<std::int64_t>(values_ * sizeof(float));
  std::fseek(file_.get(), 0, SEEK_END);
  const std::int64_t size = std::ftell(file_.get());
  // What ended in the middle of a render left a part of it.
  while (std::fseek(file_.get(), end_, SEEK_SET) == 0 && read_line(line)) {
    const std::int64_t place = std::ftell(file_.get());
    if (place + bytes > size) break;
    try {
      MeasuredRun run = run_from(nlohmann::json::parse(line));
      run.place = place;
      runs_.push_back(std::move(run));
    } catch (const nlohmann::json::exception&) {
      break;
    }
    end_ = place + bytes;
  }
}

std::vector<MeasuredRun> Measurements::runs_of(const std::string& key) const {
  std::vector<MeasuredRun> found;
  for (const MeasuredRun& run : runs_)
    if (run.key == key) found.push_back(run);
  return found;
}

std::string Measurements::add(MeasuredRun run, const std::vector<float>& pixels) {
  const std::string line = line_of(to_json(run));
  if (std::fseek(file_.get(), end_, SEEK_SET) != 0 ||
      std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() ||
      std::fwrite(pixels.data(), sizeof(float), pixels.size(), file_.get()) != pixels.size() ||
      std::fflush(file_.get()) != 0)
    return fmt::format("cannot write '{}': {}", path_.empty() ? "a temporary file" : path_,
                       std::strerror(errno));
  run.place = end_ + static_cast<std::int64_t>(line.size());
  end_ = run.place + static_cast<std::int64_t>(pixels.size() * sizeof(float));
  runs_.push_back(std::move(run));
  return {};
}

std::vector<float> Measurements::pixels(const MeasuredRun& run) const {
  std::vector<float> pixels(values_);
  if (std::fseek(file_.get(), run.place, SEEK_SET) != 0 ||
      std::fread(pixels.data(), sizeof(float), values_, file_.get()) != values_)
    pixels.assign(values_, 0);
  return pixels;
}

}  // namespace tyndall::tools
