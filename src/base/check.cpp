#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace tyndall {

void check_failed(const char* file, int line, std::string_view message) {
  fmt::print(stderr, "tyndall: internal error at {}:{}: {}\n", file, line, message);
  std::abort();
}

}  // namespace tyndall
