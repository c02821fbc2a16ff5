// The program: everything is in commands.
#include <cstdio>
#include <new>

#include "tools/commands.h"
#include "tools/memory.h"

int main(int argc, char** argv) {
  try {
    return static_cast<int>(tyndall::tools::run(argc, argv));
  } catch (const tyndall::tools::OutOfMemory& error) {
    std::fprintf(stderr, "tyndall: error: there is not enough memory %s\n", error.what());
    return static_cast<int>(tyndall::tools::ExitStatus::problem);
  } catch (const std::bad_alloc&) {
    std::fputs("tyndall: error: there is not enough memory\n", stderr);
    return static_cast<int>(tyndall::tools::ExitStatus::problem);
  }
}
