// Words of other programs: what to write for them here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace tyndall::syntax {

// Where a word stands.
enum class ForeignUse : std::uint8_t {
  statement,  // cone { … }, import …
  value,      // lerp(…), red
  light,      // light sun { … }
  camera,     // camera pinhole { … }
  parameter,  // sphere { position: … }
  output,     // medium: { g = … }
  unit,       // 3degrees
  between,    // 5 mod 3
};

struct ForeignWord {
  std::string_view word, help;
  std::string_view needs = {};  // parameters: the one that the help names, which the thing must have
};

// The table for a use; the first row that fits counts.
std::span<const ForeignWord> foreign_words(ForeignUse use);

// What is written for the word in this language; empty for any word that the table has not.
std::string_view help_for_foreign_word(ForeignUse use, std::string_view word);
// The row for a parameter of a thing that has the parameters `known`, or null.
const ForeignWord* find_foreign_parameter(std::string_view word, std::span<const std::string_view> known);

}  // namespace tyndall::syntax
