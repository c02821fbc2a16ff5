// What the program says to the shell when it ends.
#pragma once

namespace tyndall::tools {

enum class ExitStatus : int {
  done = 0,
  problem = 1,        // in a scene, an input or an output: told on standard error
  misuse = 2,         // of the command line
  test_failed = 3,    // a comparison or golden test
  interrupted = 130,  // what was rendered is saved, if there was anything
};

}  // namespace tyndall::tools
