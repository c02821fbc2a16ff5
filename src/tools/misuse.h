// What is wrong with a command line, and the way out.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace tyndall::tools {

// Makes each option and file of all commands refuse an empty value.
void refuse_empty_values(CLI::App& program);

// The words of the command line, without the program's own name. Files in brackets, as `[a]`, get the current
// folder before them, for the parser would take the brackets off.
std::vector<std::string> words_of(const CLI::App& program, std::span<char* const> arguments);

// The complaint about a value joined to its option in a way that is not read, as in `--samples=` and
// `-o=a.png`; empty where there is none. `arguments` without the program's own name.
std::string misjoined_value(std::span<char* const> arguments);

// The complaint about a command line that could not be read: a word that names no command or option is told
// first, with the one that was likely meant.
std::string explain_misuse(const CLI::App& program, const CLI::ParseError& error);

}  // namespace tyndall::tools
