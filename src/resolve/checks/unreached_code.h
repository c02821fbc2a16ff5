// Checks of what the run never came to: templates never called, branches never taken.
#pragma once

namespace tyndall::resolve {

struct Run;

// Looks the names, statements and parameters up in the main file's blocks that were passed over and never
// run.
void check_never_run(Run& run);

}  // namespace tyndall::resolve
