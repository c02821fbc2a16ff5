// Ctrl-C: the first asks the renderer to stop and save, the second ends the program at once.
#pragma once

#include <atomic>

namespace tyndall::tools {

// From now on SIGINT and SIGTERM set the returned flag; the second one ends the process with status 130.
const std::atomic<bool>& catch_interrupts();

}  // namespace tyndall::tools
