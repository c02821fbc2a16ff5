// A slice in false colours: dark to light from the least value to the largest, with a scale bar.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "image/false_colors.h"
#include "tools/slice.h"

namespace tyndall::tools {

namespace {

using image::color_of_level;
using Color = image::SrgbColor;

constexpr Color paper{0.13, 0.13, 0.15}, ink{0.9, 0.9, 0.9};
constexpr int margin = 8, bar_width = 16, letter_scale = 2, letter_pitch = 4 * letter_scale,
              line_height = 8 * letter_scale;

// Letters of three by five points, a row an octal digit from the top.
struct Letter {
  char letter;
  int rows;
};
constexpr Letter letters[] = {{'0', 075557}, {'1', 026227}, {'2', 071747}, {'3', 071717}, {'4', 055711},
                              {'5', 074717}, {'6', 074757}, {'7', 071111}, {'8', 075757}, {'9', 075717},
                              {'-', 000700}, {'+', 002720}, {'.', 000002}, {'e', 007647}, {'x', 000525},
                              {'y', 005571}, {'z', 007247}, {'=', 007070}, {' ', 000000}};

class Canvas {
 public:
  Canvas(int width, int height)
      : image_{width,
               height,
               {"R", "G", "B"},
               std::vector<float>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))} {
    fill(0, 0, width, height, paper);
  }

  void set(int x, int y, const Color& color) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    for (std::size_t k = 0; k < 3; ++k)
      image_.at(x, y, k) = image::linear_from_srgb(static_cast<float>(color[k]));
  }
  void fill(int x0, int y0, int x1, int y1, const Color& color) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) set(x, y, color);
  }
  void text(int x, int y, std::string_view text) {
    for (const char c : text) {
      for (const Letter& letter : letters)
        if (letter.letter == c)
          for (int bit = 0; bit < 15; ++bit)
            if (letter.rows >> (14 - bit) & 1) {
              const int left = x + bit % 3 * letter_scale, up = y + bit / 3 * letter_scale;
              fill(left, up, left + letter_scale, up + letter_scale, ink);
            }
      x += letter_pitch;
    }
  }
  image::Image image() && { return std::move(image_); }

 private:
  image::Image image_;
};

int text_width(std::string_view text) { return static_cast<int>(text.size()) * letter_pitch; }
std::string number(double v) { return fmt::format("{:.4g}", v); }

}  // namespace

image::Image picture_of(const Slice& slice) {
  const int panels = static_cast<int>(slice.components.size());
  const std::string high = number(static_cast<double>(slice.highest)),
                    low = number(static_cast<double>(slice.lowest));
  const std::string middle =
      number(0.5 * (static_cast<double>(slice.lowest) + static_cast<double>(slice.highest)));
  const int scale_width =
      bar_width + margin + std::max({text_width(high), text_width(low), text_width(middle)});
  const std::string left = fmt::format("{}={}", slice.right_axis, number(slice.left)),
                    right = number(slice.right);
  const std::string bottom = fmt::format("{}={}", slice.up_axis, number(slice.bottom)),
                    top = number(slice.top);
  const int up_width = std::max(text_width(bottom), text_width(top)) + margin;
  const int height = std::max(slice.height, 4 * line_height);
  const int panel = std::max(slice.width, text_width(left) + text_width(right) + margin);
  Canvas canvas(margin + up_width + panels * (panel + margin) + scale_width + margin,
                2 * margin + height + line_height);

  const double range = static_cast<double>(slice.highest) - static_cast<double>(slice.lowest);
  for (int c = 0; c < panels; ++c) {
    const int x0 = margin + up_width + c * (panel + margin);
    for (int y = 0; y < slice.height; ++y)
      for (int x = 0; x < slice.width; ++x) {
        const float v = slice.components[static_cast<std::size_t>(c)]
                                        [static_cast<std::size_t>(y) * static_cast<std::size_t>(slice.width) +
                                         static_cast<std::size_t>(x)];
        const double level =
            range > 0 ? (static_cast<double>(v) - static_cast<double>(slice.lowest)) / range : 0.5;
        canvas.set(x0 + x, margin + y, std::isfinite(v) ? color_of_level(level) : image::color_of_no_number);
      }
    canvas.text(x0, margin + height + letter_scale, left);
    canvas.text(x0 + panel - text_width(right), margin + height + letter_scale, right);
  }
  canvas.text(margin, margin, top);
  canvas.text(margin, margin + slice.height - line_height, bottom);
  const int bar = margin + up_width + panels * (panel + margin);
  for (int y = 0; y < height; ++y)
    canvas.fill(bar, margin + y, bar + bar_width, margin + y + 1,
                color_of_level(range > 0 ? 1 - (y + 0.5) / height : 0.5));
  const int numbers = bar + bar_width + margin;
  canvas.text(numbers, margin, high);
  if (range > 0) {
    canvas.text(numbers, margin + height / 2 - line_height / 2, middle);
    canvas.text(numbers, margin + height - 5 * letter_scale, low);
  }
  return std::move(canvas).image();
}

image::Image values_of(const Slice& slice, const std::string& name) {
  image::Image image{slice.width, slice.height, {}, {}};
  const std::size_t channels = slice.components.size();
  for (std::size_t c = 0; c < channels; ++c)
    image.channels.push_back(channels == 1 ? name : fmt::format("{}.{}", name, "xyz"[c]));
  image.pixels.resize(slice.components[0].size() * channels);
  for (std::size_t i = 0; i < slice.components[0].size(); ++i)
    for (std::size_t c = 0; c < channels; ++c) image.pixels[i * channels + c] = slice.components[c][i];
  return image;
}

}  // namespace tyndall::tools
