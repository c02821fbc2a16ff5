// A reference that is read from a file.
#pragma once

#include <optional>
#include <string>

#include "tools/measure/accuracy.h"

namespace tyndall::tools {

struct GivenReference {
  std::optional<Reference> reference{};
  std::string problem{};  // fit for the user; empty when there is a reference
};

// Of the file's R, G and B, which must have this size. Where it has one half of its samples among its
// channels (`--aov half`) the two halves are independent parts.
GivenReference read_reference(const std::string& path, int width, int height);

}  // namespace tyndall::tools
