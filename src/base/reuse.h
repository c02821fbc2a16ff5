// How much of a frame's work was done for the frame before, and taken over.
#pragma once

#include <cstdint>

namespace tyndall {

struct Reuse {
  std::uint64_t kept = 0, rebuilt = 0;

  void count(bool is_kept) { ++(is_kept ? kept : rebuilt); }
};

}  // namespace tyndall
