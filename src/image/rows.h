// Pictures as rows: how they come from their files, so that no more of one need be in memory than its reader
// wants to keep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tyndall::image {

// How the numbers of a file stand for light: as they are, by the curve of sRGB (IEC 61966-2-1), or as its
// root of this degree.
struct Transfer {
  enum class Curve : std::uint8_t { linear, srgb, power } curve = Curve::linear;
  double degree = 1;
};

// What is told of a picture before its rows.
struct PictureHeader {
  int width = 0, height = 0;
  std::vector<std::string> channels{};  // all that the file has
  std::vector<std::size_t> chosen{};    // those that are read; none when what was asked for is not there
  Transfer transfer{};
};

class RowTaker {
 public:
  RowTaker() = default;
  virtual ~RowTaker() = default;
  RowTaker(const RowTaker&) = delete;
  RowTaker& operator=(const RowTaker&) = delete;

  // Once, first. A message, the rest of "cannot read 'sky.exr': ", ends the reading.
  virtual std::string begin(const PictureHeader& header) = 0;
  // The numbers of the chosen channels, interleaved; rows come from the top.
  virtual void row(std::span<const float> numbers) = 0;
};

}  // namespace tyndall::image
