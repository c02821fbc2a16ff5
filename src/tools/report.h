// Problems, told to people on standard error and to programs as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "base/diagnostics.h"
#include "base/source.h"
#include "tools/exit_status.h"

namespace tyndall::tools {

// Whether standard error wants colour: a terminal, and no NO_COLOR in the environment (no-color.org).
bool error_output_is_terminal();
bool error_output_has_color();

// Writes the text to standard error, or to standard output, as it is. A reader that went away is no problem
// of ours: whether standard output took everything is asked once, at the end of the program.
void print_message(std::string_view text);
void print_result(std::string_view text);

// Prints all messages on standard error, with their source lines.
void print_diagnostics(const Diagnostics& diagnostics, const Sources& sources);
// Prints `tyndall: error: message` (or warning) on standard error: for what has no place in a scene.
void print_error(std::string_view message);
void print_warning(std::string_view message);
// Prints the error, and is how a command ends that was called in a wrong way.
ExitStatus misuse(std::string_view message);

// A list of {severity, file, line, column, end_line, end_column, message, help, notes}; places are left out
// where there are none.
nlohmann::json to_json(const Diagnostics& diagnostics, const Sources& sources);
// Prints the value on a line of its own, and lets it be seen at once.
void print_json_line(const nlohmann::json& value);
// Prints the value on standard output, with bytes that are no UTF-8 replaced.
void print_json(const nlohmann::json& value);

}  // namespace tyndall::tools
