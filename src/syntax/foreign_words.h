// Words of other scene languages: what to write for them here.
#pragma once

#include <string_view>

namespace tyndall::syntax {

// What is written for a statement of POV-Ray or PBRT in this language; empty for any other word.
std::string_view help_for_foreign_word(std::string_view word);

}  // namespace tyndall::syntax
