// Whether a picture is the one that would be rendered now, and why not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/identity.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// How the light of `was` differs from that of `is`, each difference as a sentence without its end: "the
// scene's text has changed", "'smoke.vdb' has changed", "--samples was 64, is 128". The SIMD class is left
// out: it changes last digits alone.
std::vector<std::string> differences(const PictureIdentity& was, const PictureIdentity& is);
// How they are shown in other ways.
std::vector<std::string> view_differences(const PictureIdentity& was, const PictureIdentity& is);
// How pictures of that name differ: light, and of developed ones the view.
std::vector<std::string> differences(const PictureIdentity& was, const PictureIdentity& is,
                                     const std::string& output);

// What the identity of these arguments is, as far as can be told without reading the scene: that of `was`
// holds for what follows from the scene's text. Files are looked up beside the scene, and their hashes are
// empty where they are not there. arguments.scene.frame must be given, unless `was` has the frame that is
// wanted.
PictureIdentity expected_identity(const PictureIdentity& was, const RenderArguments& arguments);

// Why the picture (.exr, .png) or part (.tynpart) at arguments.output is not what rendering would give, in
// words like those of differences(); empty when it is. Neither the scene is built nor the pixels are read.
std::vector<std::string> why_stale(const RenderArguments& arguments);

// Whether the picture at `path` has all pixels and samples of a part, made of the same as the part, and shows
// them as it says.
bool has_part(const std::string& path, const PictureIdentity& whole, PictureIdentity part);

// Whether the picture at arguments.part_of is there, as it would be rendered, with all pixels and samples of
// the part that the arguments ask for. False where they name none.
bool is_in_whole(const RenderArguments& arguments);

// What the picture or part at a path was made of; nothing when it is not there, tells nothing, or is not
// finished.
std::optional<PictureIdentity> identity_of_finished(const std::string& path);

}  // namespace tyndall::tools
