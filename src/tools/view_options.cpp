#include "tools/view_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <variant>

#include "image/white_balance.h"
#include "tools/numbers.h"
#include "tools/part_facts.h"
#include "vm/kernels/blackbody.h"

namespace tyndall::tools {

namespace {

// As `blackbody` of the language has it.
Rgb blackbody(double kelvin) {
  const vm::BlackbodyTable& table = vm::blackbody_table();
  const double at = double{vm::blackbody_coolest} * (vm::blackbody_entries - 1) / kelvin;
  const auto i = std::min(static_cast<std::size_t>(at), std::size_t{vm::blackbody_entries - 2});
  const auto part = static_cast<float>(at - static_cast<double>(i));
  const auto mixed = [&](const auto& entries) { return entries[i] + part * (entries[i + 1] - entries[i]); };
  return {mixed(table.red), mixed(table.green), mixed(table.blue)};
}

// "3200", "3200K", "1,0.8,0.6": the colour of the light; nothing where it is none.
std::optional<Rgb> read_white(std::string_view text) {
  constexpr double coolest = 1000, hottest = 40000;
  if (const auto parts = split_as("R,G,B", text)) {
    Rgb color;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto number = read_decimal<float>((*parts)[k]);
      if (!number || *number < 0) return std::nullopt;
      color[k] = *number;
    }
    return image::WhiteBalance::can_balance(color) ? std::optional(color) : std::nullopt;
  }
  if (text.ends_with('K')) text.remove_suffix(1);
  const auto kelvin = read_decimal<double>(text);
  if (!kelvin || !(*kelvin >= coolest && *kelvin <= hottest)) return std::nullopt;
  return blackbody(*kelvin);
}

}  // namespace

void add_view_options(CLI::App& command, GivenView& given, const std::string& instead_of) {
  const RealOption& exposure = real_option("--exposure");
  add_text_option(
      command, exposure.name, exposure.form,
      "Exposure in stops, metered (auto), or stops beside the metered ones: auto(1); " + instead_of,
      [&given, &exposure](const std::string& text) {
        given.exposure = image::read_exposure(text);
        if (!given.exposure) refuse(exposure.name, exposure.wanted, text);
      });
  std::vector<std::string_view> names;
  std::string form;
  for (const image::TonemapInfo& row : image::tonemaps) {
    names.push_back(row.name);
    form += (form.empty() ? "" : "|") + std::string(row.name);
  }
  add_text_option(command, "--tonemap", form,
                  "Tone curve from light to a display, none: clamped; " + instead_of,
                  [&given, names](const std::string& text) {
                    given.tonemap = image::read_tonemap(text);
                    if (!given.tonemap) refuse_name("--tonemap", names, text);
                  });
}

void add_lens_options(CLI::App& command, GivenView& given) {
  const RealOption &white = real_option("--white-balance"), &bloom = real_option("--bloom");
  add_text_option(command, white.name, white.form,
                  "The light that is to look white: its temperature in kelvin, or its colour (linear)",
                  [&given, &white](const std::string& text) {
                    given.white = read_white(text);
                    if (!given.white) refuse(white.name, white.wanted, text);
                  });
  add_text_option(
      command, bloom.name, bloom.form,
      "Share of the light that glows around where it fell, as lenses and eyes scatter it; 0.05 is "
      "much",
      [&given, &bloom](const std::string& text) {
        given.bloom = read_decimal<double>(text);
        if (!given.bloom || !(*given.bloom >= 0 && *given.bloom <= 1)) refuse(bloom.name, bloom.wanted, text);
      });
}

image::View in_place(const GivenView& given, image::View view) {
  if (given.exposure) view.exposure = *given.exposure;
  if (given.tonemap) view.tonemap = *given.tonemap;
  if (given.white) view.white = given.white;
  if (given.bloom) view.bloom = *given.bloom;
  return view;
}

image::View view_of(const scene::Scene& scene) {
  return std::visit(
      [](const scene::CameraView& camera) {
        return image::View{.exposure = camera.exposure, .tonemap = camera.tonemap};
      },
      scene.camera);
}

bool is_developed(const std::string& output) { return !output.ends_with(".exr") && !is_part(output); }

std::vector<std::pair<std::string, std::string>> as_texts(const image::View& view) {
  return {{std::string(exposure_setting), describe(view.exposure)},
          {std::string(tonemap_setting), std::string(describe(view.tonemap))}};
}

std::string text_of(const GivenView& given, std::string_view name, const std::string& own) {
  if (name == exposure_setting && given.exposure) return describe(*given.exposure);
  if (name == tonemap_setting && given.tonemap) return std::string(describe(*given.tonemap));
  return own;
}

bool is_view_setting(std::string_view name) { return name == exposure_setting || name == tonemap_setting; }

}  // namespace tyndall::tools
