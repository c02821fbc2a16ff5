// Signals that end a run: Ctrl-C, a closed terminal, a farm's stop, the end of the processor time.
#pragma once

#include <atomic>

namespace tyndall::tools {

// From now on they end the process as ever, but leave no half-written file; a file that would grow beyond the
// allowed size is an error of writing instead of a signal. Those that the process was started to ignore stay
// ignored (nohup).
void clean_up_at_signals();

// From now on the first one sets the returned flag, so that what there is can be saved; the second one ends
// the process with status 128 + its number.
const std::atomic<bool>& catch_interrupts();

}  // namespace tyndall::tools
