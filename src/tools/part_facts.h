// What the files of parts (.tynpart) and checkpoints tell of what they hold.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "render/context/clamped_light.h"
#include "tools/identity.h"

namespace tyndall::tools {

struct PartFacts {
  PictureIdentity identity;
  bool is_checkpoint = false;                           // of a render that has not ended
  std::optional<render::ClampedLight> clamped_light{};  // of a scene with a clamp
  std::string step_bias{};                              // as PictureFindings have it
};

bool is_part(const std::string& path);  // by its extension
inline constexpr std::string_view part_extension = ".tynpart", checkpoint_extension = ".checkpoint";

// As JSON, and back; nothing when it is something else.
std::string to_text(const PartFacts& facts);
std::optional<PartFacts> part_facts_from(const std::string& text);

}  // namespace tyndall::tools
