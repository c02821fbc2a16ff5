// Channels of a picture, each by itself, with a border of pixels so that windows need not look where it ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace tyndall::denoise {

// Pixels beside the picture: what a window and the vectors of its rows reach.
inline constexpr int border = 24;

// Row by row from the top. Pixel (x, y) may lie `border` outside.
class Plane {
 public:
  Plane() = default;
  Plane(int width, int height)
      : width_(width),
        height_(height),
        stride_(width + 2 * border),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * border)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  float* at(int x, int y) { return values_.data() + offset(x, y); }
  const float* at(int x, int y) const { return values_.data() + offset(x, y); }

  // Gives the border the values of the pixels next to it.
  void extend();

 private:
  std::ptrdiff_t offset(int x, int y) const { return std::ptrdiff_t{y + border} * stride_ + x + border; }

  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> values_;
};

// Calls body(y) for every row, on several threads.
void for_rows(int height, int threads, const std::function<void(int y)>& body);

// The mean over the square of so many pixels on each side, which at the border ends with the picture.
Plane box_mean(const Plane& of, int radius, int threads);

}  // namespace tyndall::denoise
