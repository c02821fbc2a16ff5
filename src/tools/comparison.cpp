#include "tools/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/flip.h"
#include "image/outliers.h"
#include "tools/identity.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

using image::Image;

bool is_exr(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".exr";
}

std::string size_text(const Image& image) {
  const Image::Place whole = image::whole_of(image);
  std::string text = fmt::format("{}x{}", image.width, image.height);
  if (whole.whole_width != image.width || whole.whole_height != image.height)
    text += fmt::format(" at {},{} of {}x{}", whole.x, whole.y, whole.whole_width, whole.whole_height);
  return text;
}

void warn_of_not_finite(const std::string& path, const Image& image) {
  const std::uint64_t count = image::count_not_finite(image);
  if (count > 0)
    print_warning(fmt::format("'{}' has {} {} not finite, the first is {}", path, count,
                              count == 1 ? "value that is" : "values that are",
                              image::first_not_finite(image)));
}

// A picture of grey as one of colours, where the other one has colours.
void make_alike(Image& a, Image& b) {
  const auto is_grey = [](const Image& image) { return image.channels == std::vector<std::string>{"Y"}; };
  const auto has_colors = [](const Image& image) {
    const std::vector<std::string> colors{"R", "G", "B"};
    return std::all_of(colors.begin(), colors.end(), [&](const std::string& color) {
      return std::find(image.channels.begin(), image.channels.end(), color) != image.channels.end();
    });
  };
  for (const auto& [grey, other] : {std::pair(&a, &b), {&b, &a}}) {
    if (!is_grey(*grey) || !has_colors(*other)) continue;
    std::vector<float> colors;
    for (const float value : grey->pixels) colors.insert(colors.end(), 3, value);
    grey->channels = {"R", "G", "B"};
    grey->pixels = std::move(colors);
  }
}

// Why the noise of two pictures is not independent, or not told by their variances.
std::string why_no_z_test(const image::ReadResult& picture, const image::ReadResult& reference) {
  for (const image::ReadResult* read : {&picture, &reference}) {
    const auto made = identity_from(metadata_entry(read->metadata, identity_entry));
    const bool denoised =
        (made && made->is_denoised()) ||
        metadata_entry(read->metadata, developed_entry).find("denoise") != std::string::npos;
    if (denoised) return "a picture was denoised, and its variance is that of the noise before";
  }
  const std::string seed = metadata_entry(picture.metadata, "tyndall:seed");
  if (!seed.empty() && seed == metadata_entry(reference.metadata, "tyndall:seed"))
    return fmt::format("both pictures have the random numbers of seed {}: render one with another --seed",
                       seed);
  return {};
}

// Of the layer without a name, R, G and B are the picture; each other channel, such as Z and A, is one by
// itself.
void part_colors(std::vector<image::Layer>& layers) {
  if (!layers[0].name.empty()) return;
  const auto is_color = [](const std::string& channel) {
    return channel == "R" || channel == "G" || channel == "B";
  };
  std::vector<std::string>& channels = layers[0].channels;
  const auto others = std::stable_partition(channels.begin(), channels.end(), is_color);
  if (others == channels.begin()) return;
  std::vector<image::Layer> parted;
  for (auto channel = others; channel != channels.end(); ++channel) parted.push_back({*channel, {*channel}});
  channels.erase(others, channels.end());
  layers.insert(layers.begin() + 1, parted.begin(), parted.end());
}

image::Comparison compare_layer(const PicturePair& pair, const image::Layer& layer) {
  Image a = image::with_channels(pair.picture, layer.channels),
        b = image::with_channels(pair.reference, layer.channels);
  image::clear_common_infinities(a, b);
  return image::compare(a, b);
}

}  // namespace

std::vector<std::string> PicturePair::main_channels() const {
  if (layers[0].name.empty()) return layers[0].channels;
  std::vector<std::string> all;
  for (const image::Layer& layer : layers)
    all.insert(all.end(), layer.channels.begin(), layer.channels.end());
  return all;
}

std::optional<PicturePair> read_pair(const std::string& picture, const std::string& reference) {
  image::ReadResult a = image::read(picture), b = image::read(reference);
  for (const image::ReadResult* read : {&a, &b})
    if (!read->image) print_error(read->error);
  if (!a.image || !b.image) return std::nullopt;
  if (const std::string size = size_text(*a.image), other = size_text(*b.image); size != other) {
    print_error(
        fmt::format("the pictures cannot be compared: '{}' is {}, '{}' is {}; render both with the same "
                    "--resolution and --crop",
                    picture, size, reference, other));
    return std::nullopt;
  }
  make_alike(*a.image, *b.image);
  std::vector<image::Layer> layers = image::common_layers(*a.image, *b.image);
  if (layers.empty()) {
    print_error(fmt::format(
        "the pictures cannot be compared, for they have no channel in common: '{}' has {}; "
        "'{}' has {}",
        picture, fmt::join(a.image->channels, " "), reference, fmt::join(b.image->channels, " ")));
    return std::nullopt;
  }
  std::stable_partition(layers.begin(), layers.end(),
                        [](const image::Layer& layer) { return layer.name.empty(); });
  part_colors(layers);
  std::string no_z_test = why_no_z_test(a, b);
  PicturePair pair{std::move(*a.image), std::move(*b.image), std::move(layers),
                   is_exr(picture) && is_exr(reference), std::move(no_z_test)};
  const std::vector<std::string> main = pair.main_channels();
  warn_of_not_finite(picture, image::with_channels(pair.picture, main));
  warn_of_not_finite(reference, image::with_channels(pair.reference, main));
  return pair;
}

std::string_view flip_kind(std::string_view name, const PicturePair& pair) {
  if (name == "flip") return pair.are_light ? "hdr-flip" : "ldr-flip";
  return name;
}

Image errors_of(std::string_view kind, const PicturePair& pair, double pixels_per_degree) {
  const std::vector<std::string> main = pair.main_channels();
  const Image picture = image::with_channels(pair.picture, main),
              reference = image::with_channels(pair.reference, main);
  if (kind == "relative") return image::relative_errors(picture, reference);
  return flip_kind(kind, pair) == "hdr-flip" ? image::flip_hdr(picture, reference, pixels_per_degree)
                                             : image::flip_ldr(picture, reference, pixels_per_degree);
}

ComparisonResult compare_pair(const PicturePair& pair) {
  ComparisonResult result;
  const std::vector<std::string> main = pair.main_channels();
  const Image picture = image::with_channels(pair.picture, main),
              reference = image::with_channels(pair.reference, main);
  result.main = image::compare(picture, reference);
  result.psnr = result.main.psnr(pair.are_light ? result.main.reference_max : 1);
  result.outliers = image::share_of_outliers(picture);
  result.reference_outliers = image::share_of_outliers(reference);
  if (result.main.not_finite == 0 && pair.no_z_test.empty())
    result.z_test = image::z_test(pair.picture, pair.reference);
  if (pair.layers[0].name.empty())
    for (std::size_t i = 1; i < pair.layers.size(); ++i)
      result.layers.emplace_back(pair.layers[i].name, compare_layer(pair, pair.layers[i]));
  return result;
}

nlohmann::json to_json(const image::ZTest& test) {
  const image::ZTest::Mean& mean = test.least_likely;
  return {{"accepted", test.accepted_share()},
          {"p", test.p_of_means},
          {"agrees", test.agrees()},
          {"least_likely",
           {{"channel", mean.channel},
            {"x", mean.x},
            {"y", mean.y},
            {"width", mean.width},
            {"height", mean.height},
            {"mean", mean.value},
            {"reference_mean", mean.reference},
            {"standard_error", mean.standard_error}}}};
}

nlohmann::json to_json(const ComparisonResult& result) {
  nlohmann::json json{{"relmse", result.main.relative_mse},
                      {"mse", result.main.mse},
                      {"psnr", result.psnr},  // null where it is infinite
                      {"max_difference", result.main.max_difference},
                      {"mean", result.main.mean},
                      {"reference_mean", result.main.reference_mean},
                      {"not_finite", result.main.not_finite},
                      {"outliers", result.outliers},
                      {"reference_outliers", result.reference_outliers}};
  if (result.flip) {
    json["flip"] = *result.flip;
    json["flip_kind"] = result.flip_kind;
  }
  if (result.z_test) json["z_test"] = to_json(*result.z_test);
  for (const auto& [name, comparison] : result.layers)
    json["layers"][name] = {{"relmse", comparison.relative_mse},
                            {"max_difference", comparison.max_difference},
                            {"not_finite", comparison.not_finite}};
  return json;
}

std::string describe(const image::ZTest& test, const Image& image) {
  const image::ZTest::Mean& mean = test.least_likely;
  std::string text = fmt::format("{:.2f} % of pixels accepted, means p = {:.3g}", 100 * test.accepted_share(),
                                 test.p_of_means);
  if (test.agrees()) return text;
  return text + fmt::format("; mean {} {} is {:.6g} instead of {:.6g}, {:.1f} standard errors away",
                            mean.channel, image::describe_place(mean, image), mean.value, mean.reference,
                            std::abs(mean.t()));
}

std::string to_text(const ComparisonResult& result, const PicturePair& pair) {
  std::string text = fmt::format("relmse {:.6g}\nmse {:.6g}\npsnr {:.4g} dB\n", result.main.relative_mse,
                                 result.main.mse, result.psnr);
  if (result.flip) text += fmt::format("{} {:.6g}\n", result.flip_kind, *result.flip);
  text += fmt::format("max difference {:.6g}\nmean {:.6g}\nreference mean {:.6g}\n",
                      result.main.max_difference, result.main.mean, result.main.reference_mean);
  text += fmt::format("outliers {:.3g} %\nreference outliers {:.3g} %\n", 100 * result.outliers,
                      100 * result.reference_outliers);
  if (result.main.not_finite > 0) text += fmt::format("values not finite {}\n", result.main.not_finite);
  if (result.z_test)
    text += fmt::format("z-test {}: {}\n", result.z_test->agrees() ? "agrees" : "differs",
                        describe(*result.z_test, pair.picture));
  for (const auto& [name, comparison] : result.layers) {
    text += fmt::format("{}: relmse {:.6g}, max difference {:.6g}", name, comparison.relative_mse,
                        comparison.max_difference);
    if (comparison.not_finite > 0) text += fmt::format(", values not finite {}", comparison.not_finite);
    text += "\n";
  }
  return text;
}

}  // namespace tyndall::tools
