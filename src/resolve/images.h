// The picture files of a scene: found beside the file that names them, decoded once something looks them up.
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "eval/images.h"
#include "image/plane_maker.h"

namespace tyndall::resolve {

struct Run;
struct KeptParts;

class Images final : public eval::ImageReader {
 public:
  explicit Images(Run& run);

  std::string find(const std::string& name, Span span) override;
  std::vector<PlanePointer> planes(const eval::Image& image) override;

  struct Decoded {
    std::vector<PlanePointer> planes;
    std::string kind;         // Asset's
    std::uint64_t bytes = 0;  // in memory, or in a temporary file
    bool is_paged = false;
  };
  using Key = std::tuple<std::string, std::string, eval::Image::Encoding>;  // path and channel
  using Known = std::map<Key, Decoded>;

  // What another run of the same scene has decoded.
  void share(const Images& other) { known_ = other.known_; }
  // Gives the next frame what this one looked up.
  void keep_in(KeptParts& parts);

  // While nothing will be rendered from what is evaluated (bodies that nothing uses), lookups are in
  // stand-ins and no file is decoded.
  void stand_in(bool on) { stand_in_ = on; }

 private:
  Decoded decoded(const eval::Image& image);
  bool take_kept(const Key& key, Decoded& into);
  void tell_of(const image::PlaneMaker& maker, const eval::Image& image, const std::string& file);

  Run& run_;
  Known known_;
  image::PictureMemory memory_;
  bool stand_in_ = false;
};

}  // namespace tyndall::resolve
