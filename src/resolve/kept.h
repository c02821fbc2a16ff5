// What frames of one scene have in common, kept from one to the next: included files, overrides, pictures,
// grids, files of meshes. A frame takes over what it uses; what it does not use is gone after it, so that a
// long sequence takes no more memory than its two largest neighbours.
#pragma once

#include <memory>
#include <optional>

#include "base/reuse.h"
#include "scene/scene.h"

namespace tyndall::resolve {

struct KeptParts;

class Kept {
 public:
  Kept();
  ~Kept();
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  // Whether nothing of the last scene's text asked for `time` or `frame`: others have the same errors.
  bool timeless = false;
  // Whether the last scene is, but for its numbers `frame` and `time`, that of all frames: it was read
  // without errors, and no shader of it reads the time.
  bool still = false;
  // What decides the time of its frames; nothing: it is always 0.
  std::optional<scene::Animation> animation;
  // Of the last scene: text, pictures, grids and files of meshes.
  Reuse files;

  // Pictures, grids and files of meshes are read anew: one of them has changed.
  void forget_files();

  KeptParts& parts() { return *parts_; }

 private:
  std::unique_ptr<KeptParts> parts_;
};

}  // namespace tyndall::resolve
