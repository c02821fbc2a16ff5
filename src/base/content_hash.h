// A short name of what bytes hold: to tell whether they changed, not to withstand an attack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tyndall {

// Takes bytes in pieces of any length: the hash is that of all of them in a row. 64 bits: two texts that
// differ by accident have one name with a probability of 2^-64. Eight bytes at a time are mixed as in
// MurmurHash64A (Appleby 2008), by its constants: some GB/s.
class ContentHash {
 public:
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
  void add(std::uint64_t number);
  std::uint64_t value() const;
  // 16 digits, hexadecimal.
  std::string text() const;

 private:
  std::uint64_t hash_ = 0x8445d61a4e774912u, rest_ = 0, length_ = 0;
};

}  // namespace tyndall
