// Words of a shell's command line.
#pragma once

#include <span>
#include <string>

namespace tyndall::tools {

// The text as one word of POSIX sh: as it is where it means nothing to a shell, or between quotes.
std::string shell_word(const std::string& text);

// Several, with spaces between them.
std::string shell_words(std::span<const std::string> texts);

}  // namespace tyndall::tools
