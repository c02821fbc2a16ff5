// The commands of the program, one file each: NAME_command.cpp, with its row.
#pragma once

#include <functional>
#include <string_view>

#include "tools/exit_status.h"

namespace CLI {
class App;
}

namespace tyndall::tools {

// What a command does once the whole command line is read.
using Action = std::function<ExitStatus()>;

struct Command {
  std::string_view name;
  std::string_view help;                     // in one line
  Action (*add_options)(CLI::App& command);  // gives what is done with their values
};

extern const Command render_command, develop_command, merge_command, plan_command, sheet_command,
    check_command, format_command, inspect_command, compare_command, golden_command, measure_command,
    help_command;
// All of them, in the order of the help.
inline constexpr const Command* commands[] = {
    &render_command,  &develop_command, &merge_command,  &plan_command,    &check_command, &format_command,
    &inspect_command, &compare_command, &golden_command, &measure_command, &sheet_command, &help_command};

// Reads the command line and does what it says.
ExitStatus run(int argc, char** argv);

}  // namespace tyndall::tools
