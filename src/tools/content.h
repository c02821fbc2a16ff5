// Names of what files hold, to tell whether they changed.
#pragma once

#include <string>
#include <string_view>

#include "base/source.h"
#include "syntax/token.h"

namespace tyndall::tools {

// Of a text; 64 bits in hexadecimal, like the others.
std::string hash_of_text(std::string_view text);

// Of a scene's words: comments, empty lines and columns do not change them. How a camera's picture is shown,
// where it is said in plain numbers and words, has a hash of its own, empty where that is not said.
struct WordsHashes {
  std::string light, view;
};
WordsHashes hash_of_words(const syntax::TokenList& tokens, const Sources& sources);

// Of a file's bytes; empty when it cannot be read. A file that stays as it is, by its place on the disk, its
// size and its time, is read once in a process. May be called by any thread.
std::string hash_of_file(const std::string& path);

}  // namespace tyndall::tools
