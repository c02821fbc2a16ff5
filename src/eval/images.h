// Pictures as values: how the evaluator asks for files without knowing how they are found and read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/plane.h"
#include "base/source.h"
#include "base/vec.h"

namespace tyndall::eval {

// What `image("wood.exr")` gives: a picture that is decoded when something first looks it up.
struct Image {
  std::string path, channel;  // channel: empty for the colour
  enum class Encoding : std::uint8_t { of_file, srgb, linear } encoding = Encoding::of_file;
  Vec3d factor{1, 1, 1};      // of `0.5 * image(…)`
  Span span;                  // of the call of `image`
};

// Given by whoever runs the evaluator. Both report their errors at `span`.
class ImageReader {
 public:
  virtual ~ImageReader() = default;
  // The path of the file that the text at `span` names; empty after an error.
  virtual std::string find(const std::string& name, Span span) = 0;
  // The planes of the image's colour (three) or channel (one), linear; none after an error.
  virtual std::vector<PlanePointer> planes(const Image& image) = 0;
};

}  // namespace tyndall::eval
