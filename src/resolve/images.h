// The picture files of a scene: found beside the file that names them, decoded once something looks them up.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "eval/images.h"

namespace tyndall::resolve {

struct Run;

// Memory of all pictures of a scene, at 4 bytes a number: two of 8192 x 4096 in colour and more.
inline constexpr std::uint64_t max_picture_bytes = std::uint64_t{1} << 30;

class Images final : public eval::ImageReader {
 public:
  explicit Images(Run& run) : run_(run) {}

  std::string find(const std::string& name, Span span) override;
  std::vector<PlanePointer> planes(const eval::Image& image) override;

  // What another run of the same scene has decoded.
  void share(const Images& other) { known_ = other.known_; }

  // While nothing will be rendered from what is evaluated (bodies that nothing uses), lookups are in
  // stand-ins and no file is decoded.
  void stand_in(bool on) { stand_in_ = on; }

 private:
  std::vector<PlanePointer> decoded(const eval::Image& image);

  Run& run_;
  std::map<std::pair<std::string, std::string>, std::vector<PlanePointer>> known_;  // by path and channel
  std::uint64_t bytes_left_ = max_picture_bytes;
  bool stand_in_ = false;
};

}  // namespace tyndall::resolve
