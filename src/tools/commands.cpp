// The command line as a whole: all commands, --version, misuse.
#include "tools/commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "tools/interrupt.h"
#include "tools/misuse.h"
#include "tools/report.h"

namespace tyndall::tools {

ExitStatus run(int argc, char** argv) {
  clean_up_at_signals();
  CLI::App program("Tyndall renders light in fog, smoke, cloud and fire from a scene written as text.",
                   "tyndall");
  program.set_version_flag("--version", "tyndall " TYNDALL_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(34);
  // Of an option that is given again the last counts; those that are lists go on.
  program.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);

  Action action;
  for (const Command* row : commands) {
    CLI::App* command = program.add_subcommand(std::string(row->name), std::string(row->help));
    command->callback([&action, run = row->add_options(*command)] { action = run; });
  }
  refuse_empty_values(program);

  const std::string misjoined = misjoined_value({argv + 1, argv + std::max(argc, 1)});
  if (!misjoined.empty()) {
    print_error(misjoined);
    return ExitStatus::misuse;
  }
  try {
    std::vector<std::string> words = words_of(program, {argv + 1, argv + std::max(argc, 1)});
    std::reverse(words.begin(), words.end());  // as the parser takes them
    program.parse(std::move(words));
  } catch (const CLI::Success& request) {
    program.exit(request);  // prints the help or version that was asked for
    return ExitStatus::done;
  } catch (const CLI::ParseError& error) {
    print_error(explain_misuse(program, error));
    return ExitStatus::misuse;
  }
  const ExitStatus status = action();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  print_error("cannot write to standard output");
  return status == ExitStatus::done ? ExitStatus::problem : status;
}

}  // namespace tyndall::tools
