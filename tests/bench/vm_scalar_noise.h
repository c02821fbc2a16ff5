// Gradient noise for one point at a time, as one writes it in plain C++: hashed, gradients from a table, no
// branches. The values are not the VM's; the work is the same.
#pragma once

#include <cstdint>

namespace tyndall::vm {

inline constexpr float scalar_edges[12][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0},
                                              {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                              {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};

inline float scalar_corner(std::uint32_t h, float x, float y, float z) {
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  const float* g = scalar_edges[(std::uint64_t{h} * 12) >> 32];
  return g[0] * x + g[1] * y + g[2] * z;
}

inline float scalar_noise(float px, float py, float pz, std::uint32_t seed) {
  const auto whole = [](float v) {
    const int i = static_cast<int>(v);
    return i - (v < static_cast<float>(i));
  };
  const int ix = whole(px), iy = whole(py), iz = whole(pz);
  const float x = px - static_cast<float>(ix), y = py - static_cast<float>(iy),
              z = pz - static_cast<float>(iz);
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const std::uint32_t hx = static_cast<std::uint32_t>(ix) * 0x9e3779b1u ^ seed,
                      hy = static_cast<std::uint32_t>(iy) * 0x85ebca77u,
                      hz = static_cast<std::uint32_t>(iz) * 0xc2b2ae3du;
  const std::uint32_t kx = (static_cast<std::uint32_t>(ix) + 1) * 0x9e3779b1u ^ seed, ky = hy + 0x85ebca77u,
                      kz = hz + 0xc2b2ae3du;
  const float u = fade(x), v = fade(y), w = fade(z);
  const float a = mix(scalar_corner(hx ^ hy ^ hz, x, y, z), scalar_corner(kx ^ hy ^ hz, x - 1, y, z), u);
  const float b =
      mix(scalar_corner(hx ^ ky ^ hz, x, y - 1, z), scalar_corner(kx ^ ky ^ hz, x - 1, y - 1, z), u);
  const float c =
      mix(scalar_corner(hx ^ hy ^ kz, x, y, z - 1), scalar_corner(kx ^ hy ^ kz, x - 1, y, z - 1), u);
  const float d =
      mix(scalar_corner(hx ^ ky ^ kz, x, y - 1, z - 1), scalar_corner(kx ^ ky ^ kz, x - 1, y - 1, z - 1), u);
  return mix(mix(a, b, v), mix(c, d, v), w);
}

inline float scalar_fbm(float x, float y, float z, int octaves) {
  float sum = 0, weight = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * scalar_noise(x, y, z, static_cast<std::uint32_t>(i) * 0x9e3779b9u);
    total += weight;
    weight *= 0.5f;
    x = 2 * x + 0.3125f;
    y = 2 * y + 0.6875f;
    z = 2 * z + 0.4375f;
  }
  return sum / total;
}

}  // namespace tyndall::vm
