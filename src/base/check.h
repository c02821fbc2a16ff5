// CHECK: assertions that hold in release builds too and print the values they compared.
//
// A failed CHECK is a defect of the program, never of the user's input: it ends the process after saying
// where.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace tyndall {

// Prints the message with its place to standard error and aborts.
[[noreturn]] void check_failed(const char* file, int line, std::string_view message);

}  // namespace tyndall

#define TYNDALL_CHECK_COMPARE(a, op, b)                                                                 \
  do {                                                                                                  \
    const auto& check_a_ = (a);                                                                         \
    const auto& check_b_ = (b);                                                                         \
    if (!(check_a_ op check_b_))                                                                        \
      ::tyndall::check_failed(__FILE__, __LINE__,                                                       \
                              fmt::format("{} {} {} with {} and {}", #a, #op, #b, check_a_, check_b_)); \
  } while (false)

#define CHECK(condition)                                                       \
  do {                                                                         \
    if (!(condition)) ::tyndall::check_failed(__FILE__, __LINE__, #condition); \
  } while (false)
#define CHECK_EQ(a, b) TYNDALL_CHECK_COMPARE(a, ==, b)
#define CHECK_LT(a, b) TYNDALL_CHECK_COMPARE(a, <, b)
#define CHECK_LE(a, b) TYNDALL_CHECK_COMPARE(a, <=, b)
#define CHECK_GT(a, b) TYNDALL_CHECK_COMPARE(a, >, b)
#define CHECK_GE(a, b) TYNDALL_CHECK_COMPARE(a, >=, b)
