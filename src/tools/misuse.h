// What is wrong with a command line, and the way out.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace tyndall::tools {

// The complaint about a command line that could not be read: a word that names no command or option is told
// first, with the one that was likely meant.
std::string explain_misuse(const CLI::App& program, const CLI::ParseError& error);

}  // namespace tyndall::tools
