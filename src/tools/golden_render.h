// Renders a scene as its reference was rendered, in a process of its own: one that crashes is a test that
// fails.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "tools/golden.h"
#include "tools/identity.h"

namespace tyndall::tools {

struct RenderedPicture {
  image::ReadResult read;
  std::optional<PictureIdentity> identity;
  double seconds = 0;
  std::string path, problem;  // a problem where there is no picture
};

// `made` is what the reference was made of, where there is one; `seed` takes precedence over its.
RenderedPicture render_like(const GoldenArguments& arguments, const std::string& scene,
                            const std::optional<PictureIdentity>& made, std::optional<std::uint64_t> seed,
                            const std::string& output, int threads);

// Why a picture made in this way cannot be rendered again by golden; empty where it can.
std::string why_not_again(const PictureIdentity& made);

}  // namespace tyndall::tools
