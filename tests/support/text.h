// Numbers in the names of cases.
#pragma once

#include <fmt/format.h>

#include <string>

namespace tyndall::support {

inline std::string short_number(double value) { return fmt::format("{:.4g}", value); }

}  // namespace tyndall::support
