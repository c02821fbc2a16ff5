// What is wrong with a thing of a scene, and the checks that many things share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace tyndall {

// One thing wrong: the parameter it is about, what was wanted and found, and the way out (may be empty).
struct Problem {
  std::string_view field;
  std::string message;
  std::string help = {};
};
using Problems = std::vector<Problem>;

// "(1, 2, 3)".
std::string text_of(const Vec3d& v);

// Each adds a problem where its wish is not met.
void want_positive(Problems& problems, std::string_view field, double value, std::string help = {});
void want_not_negative(Problems& problems, std::string_view field, double value);
void want_direction(Problems& problems, std::string_view field, const Vec3d& v);
// An emitted quantity: every channel is finite and not negative.
void want_color(Problems& problems, std::string_view field, const std::optional<Rgb>& color);
// u × v must span an area that doubles can hold.
void want_area(Problems& problems, const Vec3d& u, const Vec3d& v);
// `from` and `to` must be apart.
void want_height(Problems& problems, const Vec3d& from, const Vec3d& to, std::string help);

}  // namespace tyndall
