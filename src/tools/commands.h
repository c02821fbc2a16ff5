// The commands of the program, one file each.
#pragma once

#include <functional>

#include "tools/exit_status.h"

namespace CLI {
class App;
}

namespace tyndall::tools {

// Reads the command line and does what it says.
ExitStatus run(int argc, char** argv);

// What the chosen command does once the whole command line is read.
using Action = std::function<ExitStatus()>;

// Each adds one subcommand to the program; when the user chose it, parsing sets `action`.
void add_render_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_format_command(CLI::App& program, Action& action);
void add_inspect_command(CLI::App& program, Action& action);
void add_compare_command(CLI::App& program, Action& action);

}  // namespace tyndall::tools
