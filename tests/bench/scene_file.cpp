#include "scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "denoise/denoise.h"
#include "image/compare.h"
#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall {

std::optional<scene::Scene> read_scene(const std::string& name, std::string text,
                                       std::vector<std::pair<std::string, std::string>> overrides) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add(name, std::move(text));
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  resolve::Options options;
  options.overrides = std::move(overrides);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, options, diagnostics);
  if (!diagnostics.has_errors()) return scene;
  fmt::print(stderr, "{}", render_text(diagnostics, sources, false));
  return std::nullopt;
}

std::optional<scene::Scene> load_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return read_scene(path, {std::istreambuf_iterator<char>(file), {}});
}

image::Image picture_of(const image::Image& image) {
  const auto channels = denoise::undenoised_channels(image).value();
  image::Image picture{image.width, image.height, {"R", "G", "B"}, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (const std::size_t channel : channels) picture.pixels.push_back(image.at(x, y, channel));
  return picture;
}

PictureCost cost_of(const compile::CompiledScene& world, const render::RenderOptions& options,
                    const image::Image& reference) {
  const render::RenderResult result = render::render(world, options);
  return {result.statistics.seconds, image::compare(result.film.image(), reference).relative_mse};
}

TwoCosts alternated_costs(const compile::CompiledScene& world, const render::RenderOptions& first,
                          const render::RenderOptions& second, int samples, int reference_samples) {
  render::RenderOptions far = second;
  far.first_sample = 1 << 16;
  far.sample_count = reference_samples;
  const image::Image reference = render::render(world, far).film.image();
  std::array<std::array<PictureCost, 5>, 2> costs;
  for (std::size_t round = 0; round < costs[0].size(); ++round)
    for (std::size_t way = 0; way < 2; ++way) {
      render::RenderOptions options = way == 0 ? first : second;
      options.first_sample = samples * static_cast<int>(round);
      options.sample_count = samples;
      costs[way][round] = cost_of(world, options, reference);
    }
  for (auto& list : costs)
    std::sort(list.begin(), list.end(),
              [](const PictureCost& a, const PictureCost& b) { return a.product() < b.product(); });
  return {costs[0][2], costs[1][2]};
}

}  // namespace tyndall
