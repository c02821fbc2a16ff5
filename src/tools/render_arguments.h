// The options of `tyndall render`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"
#include "tools/choices.h"
#include "tools/load.h"
#include "tools/numbers.h"
#include "tools/setting_options.h"
#include "tools/view_options.h"

namespace tyndall::tools {

// Both ends included, as everywhere on the command line.
struct SampleRange {
  int first = 0, last = 0;
};

struct RenderArguments {
  SceneRequest scene;
  std::string output, statistics_file;
  GivenSettings settings;
  GivenView view;
  std::optional<std::vector<int>> frames;  // of a sequence, in their order
  std::string movie;                       // of the sequence; empty: none
  bool overwrite = false;                  // frames of a sequence that are there already, too
  std::optional<Pair<int>> pixel;
  std::optional<render::PixelWindow> crop;
  std::optional<std::uint64_t> sample;
  std::optional<SampleRange> sample_range;
  std::string part_of;               // the picture that the part is for: if that is there, nothing is done
  std::optional<double> error;       // root of the mean squared relative error
  std::optional<double> time_limit;  // [s]
  render::AovSet aovs;
  bool denoise = false;
  int threads = 0;
  render::Method method = render::RenderOptions{}.method;
  render::Distance distance = render::RenderOptions{}.distance;
  render::Transmittance transmittance = render::RenderOptions{}.transmittance;
  bool emission_sampling = render::RenderOptions{}.emission_sampling;
  std::optional<double> checkpoint_interval;  // [s]
  bool resume = false;                        // goes on from the checkpoint of a run that did not end
  bool strict = false, quiet = false, json = false, profile = false;
};

// Adds every option of the command, each with its check: a value that cannot be is misuse of the command
// line.
void add_render_options(CLI::App& command, RenderArguments& arguments);
// Of them --aov.
void add_output_option(CLI::App& command, render::AovSet& aovs);
// Of them those for experts: how light is sampled in media.
void add_method_options(CLI::App& command, RenderArguments& arguments);

// The value of a --crop, or a complaint.
render::PixelWindow read_window(const WholeOption& option, const std::string& text);

// The command that renders one sample again and tells what happens on its path, with all options that change
// it.
std::string replay_command(const RenderArguments& arguments, int x, int y, std::uint64_t sample);

}  // namespace tyndall::tools
