#include "base/content_hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace tyndall {
namespace {

static_assert(std::endian::native == std::endian::little, "the hash reads words as they lie in memory");

constexpr std::uint64_t factor = 0xc6a4a7935bd1e995u;
constexpr int shift = 47;

std::uint64_t mixed_word(std::uint64_t hash, std::uint64_t word) {
  word *= factor;
  word ^= word >> shift;
  word *= factor;
  return (hash ^ word) * factor;
}

}  // namespace

void ContentHash::add(std::span<const std::byte> bytes) {
  std::size_t i = 0;
  const auto take_rest = [&] {
    for (; i < bytes.size() && length_ % 8 != 0; ++i) {
      rest_ |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * (length_ % 8));
      if (++length_ % 8 == 0) {
        hash_ = mixed_word(hash_, rest_);
        rest_ = 0;
      }
    }
  };
  take_rest();
  for (; bytes.size() - i >= 8; i += 8, length_ += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    hash_ = mixed_word(hash_, word);
  }
  if (i == bytes.size()) return;
  rest_ = std::to_integer<std::uint64_t>(bytes[i++]);
  ++length_;
  take_rest();
}

void ContentHash::add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }

std::uint64_t ContentHash::value() const {
  std::uint64_t hash = mixed_word(mixed_word(hash_, rest_), length_);
  hash ^= hash >> shift;
  hash *= factor;
  return hash ^ (hash >> shift);
}

std::string ContentHash::text() const { return fmt::format("{:016x}", value()); }

}  // namespace tyndall
