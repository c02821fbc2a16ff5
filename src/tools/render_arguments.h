// The options of `tyndall render`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "render/render.h"
#include "tools/choices.h"
#include "tools/load.h"

namespace tyndall::tools {

// Both ends included, as everywhere on the command line.
struct SampleRange {
  int first = 0, last = 0;
};

// Overrides how the scene wants light that is scattered many times: `approximate` keeps the scene's numbers.
enum class MultipleScatteringChoice : std::uint8_t { full, approximate };

struct RenderArguments {
  SceneRequest scene;
  std::string output, statistics_file;
  std::optional<Pair<int>> resolution, pixel;
  std::optional<render::PixelWindow> crop;
  std::optional<int> samples, light_samples, bounces;
  std::optional<scene::Step> step;
  std::optional<MultipleScatteringChoice> multiple_scattering;
  std::optional<std::uint64_t> seed, sample;
  std::optional<SampleRange> sample_range;
  std::optional<double> error;       // root of the mean squared relative error
  std::optional<double> time_limit;  // [s]
  render::AovSet aovs;
  int threads = 0;
  render::Method method = render::RenderOptions{}.method;
  render::Distance distance = render::RenderOptions{}.distance;
  render::Transmittance transmittance = render::RenderOptions{}.transmittance;
  bool emission_sampling = render::RenderOptions{}.emission_sampling;
  bool strict = false, quiet = false, json = false, profile = false;
};

// Adds every option of the command, each with its check: a value that cannot be is misuse of the command
// line.
void add_render_options(CLI::App& command, RenderArguments& arguments);

// The scene's settings with those of the command line in their place.
void apply_settings(const RenderArguments& arguments, scene::RenderSettings& settings);

// The command that renders one sample again and tells what happens on its path, with all options that change
// it.
std::string replay_command(const RenderArguments& arguments, int x, int y, std::uint64_t sample);

}  // namespace tyndall::tools
