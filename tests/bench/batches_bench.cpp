// How well marches fill batches: the time of a segment inside of renders against full batches of the same
// segments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "bench.h"
#include "compile/compiled_scene.h"
#include "render/render.h"
#include "scene_file.h"
#include "vm/run/machine.h"

namespace tyndall {

namespace {

constexpr double target = 1.3;

// The programs of media, by fingerprint: those of materials are run for points on surfaces.
using Programs = std::unordered_set<std::uint64_t>;

Programs programs_of_media(const scene::Scene& scene) {
  Programs programs;
  for (const scene::Medium& medium : scene.media)
    programs.insert({medium.full.fingerprint, medium.extinction.fingerprint});
  return programs;
}

// Adds up what batches took.
struct Timer : vm::RunObserver {
  explicit Timer(const Programs& of_media) : programs(of_media) {}
  const Programs& programs;
  double seconds = 0;
  std::uint64_t lanes = 0, batches = 0;

  void ran(const vm::Program& program, const vm::BatchInputs&, std::size_t count, double took) override {
    if (!programs.contains(program.fingerprint)) return;
    seconds += took;
    lanes += count;
    ++batches;
  }
};

// Gathers the lanes of each program, and runs them again when there are 256.
class Refiller : public vm::RunObserver {
 public:
  explicit Refiller(const Programs& of_media) : programs_(of_media) {}
  double seconds = 0;
  std::uint64_t lanes = 0;

  void ran(const vm::Program& program, const vm::BatchInputs& inputs, std::size_t count, double) override {
    if (!programs_.contains(program.fingerprint)) return;
    Gathered& g = gathered_[program.fingerprint];
    for (const vm::Input input : program.inputs) {
      std::vector<float>& row = g.rows[static_cast<std::size_t>(input)];
      // One value for all lanes: batches with the last one's are as good.
      if (vm::is_uniform(input))
        row.assign(1, *inputs[input]);
      else
        row.insert(row.end(), inputs[input], inputs[input] + count);
    }
    g.lanes += count;
    while (g.lanes >= vm::Machine::max_lanes) run_full(program, g);
  }

 private:
  struct Gathered {
    std::array<std::vector<float>, vm::input_count> rows;
    std::size_t lanes = 0;
  };

  void run_full(const vm::Program& program, Gathered& g) {
    constexpr std::size_t full = vm::Machine::max_lanes;
    vm::BatchInputs inputs;
    for (std::size_t i = 0; i < vm::input_count; ++i) inputs.lanes[i] = g.rows[i].data();
    outputs_.resize(program.outputs.size() * full);
    std::vector<float*> rows;
    for (std::size_t k = 0; k < program.outputs.size(); ++k) rows.push_back(outputs_.data() + k * full);
    // The second of two runs: as within a render, the code and constants are at hand.
    machine_.run(program, inputs, full, rows);
    const auto begin = std::chrono::steady_clock::now();
    machine_.run(program, inputs, full, rows);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    lanes += full;
    for (const vm::Input input : program.inputs)
      if (!vm::is_uniform(input)) {
        std::vector<float>& row = g.rows[static_cast<std::size_t>(input)];
        row.erase(row.begin(), row.begin() + full);
      }
    g.lanes -= full;
  }

  const Programs& programs_;
  vm::Machine machine_;
  std::unordered_map<std::uint64_t, Gathered> gathered_;
  std::vector<float> outputs_;
};

bool has_varying_medium(const compile::CompiledScene& world) {
  return std::any_of(world.media.begin(), world.media.end(), [](const auto& m) { return !m.uniform; });
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

}  // namespace

bool bench_batches() {
  namespace fs = std::filesystem;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(TYNDALL_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".tyn") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  bool good = true;
  fmt::print("scene at 96x54, one thread    lanes a batch   ns a segment   over batches of 256 (target {})\n",
             target);
  for (const fs::path& path : paths) {
    std::optional<scene::Scene> scene = load_scene(path.string());
    if (!scene) return false;
    scene->settings.resolution.width = 96;
    scene->settings.resolution.height = 54;
    const compile::CompiledScene world = compile::compile(std::move(*scene));
    if (!has_varying_medium(world)) continue;
    const Programs programs = programs_of_media(world.scene);
    std::vector<double> ratios, times, sizes;
    for (int round = 0; round < 5; ++round) {
      render::RenderOptions options;
      options.threads = 1;
      options.sample_count = 1;
      options.first_sample = round;
      Timer timer(programs);
      options.shader_observer = &timer;
      render::render(world, options);
      Refiller refiller(programs);
      options.shader_observer = &refiller;
      render::render(world, options);
      const double one = timer.seconds / static_cast<double>(timer.lanes);
      times.push_back(1e9 * one);
      sizes.push_back(static_cast<double>(timer.lanes) / static_cast<double>(timer.batches));
      ratios.push_back(one * static_cast<double>(refiller.lanes) / refiller.seconds);
    }
    good &= median(ratios) <= target;
    fmt::print("{:<30}{:>13.0f}{:>15.0f}{:>14.2f}\n", path.stem().string(), median(sizes), median(times),
               median(ratios));
  }
  return good;
}

}  // namespace tyndall
