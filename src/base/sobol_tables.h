// The direction numbers of the Sobol' sequence, ready to be added up a byte of the index at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/sampler.h"

namespace tyndall::sobol {

using Matrix = std::array<std::uint32_t, 32>;

// Direction numbers of one dimension from its primitive polynomial (degree s, coefficients a) and first m_i.
// Joe and Kuo, "Constructing Sobol sequences with better two-dimensional projections" (2008), new-joe-kuo-6.
constexpr Matrix direction_numbers(std::uint32_t s, std::uint32_t a, std::array<std::uint32_t, 5> m) {
  Matrix v{};
  for (std::uint32_t i = 0; i < 32; ++i) {
    if (s == 0) {  // van der Corput
      v[i] = 1u << (31 - i);
    } else if (i < s) {
      v[i] = m[i] << (31 - i);
    } else {
      v[i] = v[i - s] ^ (v[i - s] >> s);
      for (std::uint32_t k = 1; k < s; ++k) v[i] ^= ((a >> (s - 1 - k)) & 1u) * v[i - k];
    }
  }
  return v;
}

inline constexpr std::array<Matrix, sobol_dimensions> matrices = {
    direction_numbers(0, 0, {}),
    direction_numbers(1, 0, {1, 0, 0}),
    direction_numbers(2, 1, {1, 3, 0}),
    direction_numbers(3, 1, {1, 3, 1}),
    direction_numbers(3, 2, {1, 1, 1}),
    direction_numbers(4, 1, {1, 1, 3, 3}),
    direction_numbers(4, 4, {1, 3, 5, 13}),
    direction_numbers(5, 2, {1, 1, 5, 5, 17}),
};

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// The same for indices and results with their bits in reverse, which saves reversing them: entry [k][b] is
// what byte k of value b adds, by dimension.
using ByteTables = std::array<std::array<std::array<std::uint32_t, sobol_dimensions>, 256>, 4>;
constexpr ByteTables byte_tables() {
  ByteTables tables{};
  for (std::uint32_t k = 0; k < 4; ++k)
    for (std::uint32_t bit = 0; bit < 8; ++bit)
      for (std::size_t d = 0; d < sobol_dimensions; ++d) {
        const std::uint32_t added = reverse_bits(matrices[d][31 - (8 * k + bit)]);
        for (std::uint32_t b = 1u << bit; b < 2u << bit; ++b)
          tables[k][b][d] = tables[k][b - (1u << bit)][d] ^ added;
      }
  return tables;
}
alignas(32) inline constexpr ByteTables tables = byte_tables();

}  // namespace tyndall::sobol
