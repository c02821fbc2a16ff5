// What decoupled marching keeps of a ray (Kulla and Fajardo, EGSR 2012, section 3): its volumes, split into
// segments. Inside a segment the medium is constant and every integral exact; light can then be taken at any
// t, by any density.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/interval.h"
#include "base/numerics.h"
#include "base/vec.h"
#include "compile/compiled_scene.h"
#include "render/march/marched_intervals.h"

namespace tyndall::render {

// A part of the ray in which the same volumes are active; segments [first, first + count).
struct Region {
  Intervald t;
  std::uint32_t first = 0, count = 0;
  bool scatters = false;
};

// One volume over segments [first, first + count): the outputs of its medium's program, row by row in
// March::outputs. A homogeneous medium has rows of one value.
struct Block {
  std::uint32_t volume = 0, first = 0, count = 0;
  std::size_t rows = 0;          // where the first row starts
  std::size_t pitch = 0;         // from one row to the next: rays that are marched together share their rows
  std::uint32_t row_length = 0;  // count, or 1

  bool holds(std::uint32_t segment) const { return first <= segment && segment < first + count; }
};

// Where the ray goes through a surface, of which `pass` lets it: transmittance falls there at once.
struct MarchCrossing {
  double t = 0;
  float pass = 1;
  Rgb before{};  // transmittance from the ray's start to the surface: set by the march
};

// A place on a marched ray, with the transmittance from the ray's start to it.
struct MarchPlace {
  double t = 0;  // [m]
  std::uint32_t segment = 0;
  Vec3d transmittance;
};

// How far a march is while it is evaluated.
struct MarchProgress {
  std::uint32_t laid = 0;                  // segments in all
  std::uint32_t before_roulette = 0;       // of them, before roulette may end the march for the first time
  std::uint32_t round_end = 0;             // up to which they are evaluated now
  std::uint32_t blocks = 0;                // evaluated: the first ones
  std::array<std::size_t, 3> crossings{};  // that the sums went over, by channel
  Vec3d emitted;                           // so far
};

// Segments of one ray, structure of arrays; a colour quantity has one row when no medium of the scene is
// chromatic. Edges increase; transmittance rises only where a march survives Russian roulette.
struct March {
  compile::Ray ray;
  int channels = 1, extinction_channels = 1;
  std::uint32_t count = 0;     // of segments; a march that roulette ended has fewer than were laid
  std::vector<double> t0, dt;  // [m]
  std::array<std::vector<float>, 3> sigma_s, sigma_t, emission;  // [1/m], [1/m], [W/m³/sr]
  std::array<std::vector<double>, 3>
      transmittance;                             // at the start of each segment; [count]: at the ray's end
  std::array<std::vector<double>, 3> scattered;  // ∫ sigma_s T from the ray's start to each segment's start
  Rgb emitted;                                   // ∫ emission T over the whole ray
  std::vector<Region> regions;
  std::vector<Block> blocks;
  // Of the media's programs, for all rays that were marched together. Marches that are not asked for them any
  // more let go of them, so that their memory is used again.
  std::shared_ptr<const std::vector<float>> outputs;
  std::vector<Intervald> scattering_intervals;     // of the regions that scatter
  std::vector<MarchedInterval> marched;            // of a march
  std::vector<compile::VolumeInterval> intervals;  // of a free path
  std::vector<MarchCrossing> crossings;            // in order of t; given by who asks for the march
  MarchProgress progress;

  bool scatters() const { return !scattering_intervals.empty(); }
  Rgb end_transmittance() const { return rgb(transmittance, extinction_channels, count); }
  Rgb total_scattered() const { return rgb(scattered, channels, count); }
  // Of the whole ray, mean of the channels; does not underflow as transmittance does.
  double optical_depth() const;
  // The row of extinction and transmittance that serves channel c.
  int extinction_row(int c) const { return extinction_channels == 1 ? 0 : c; }
  // Output k of a block at a segment that it holds.
  float output(const Block& block, std::size_t k, std::uint32_t segment) const {
    return (*outputs)[block.rows + k * block.pitch + (block.row_length == 1 ? 0 : segment - block.first)];
  }
  // The segment that holds t (of a region; the nearest one for a t in a gap by rounding).
  std::uint32_t segment_at(double t) const;
  // Transmittance from the ray's start to t, inside segment i.
  Vec3d transmittance_at(std::uint32_t i, double t) const;
  MarchPlace place_at(double t) const {
    const std::uint32_t i = segment_at(t);
    return {t, i, transmittance_at(i, t)};
  }
  Vec3d sigma_t_at(std::size_t i) const {
    return {sigma_t[extinction_row(0)][i], sigma_t[extinction_row(1)][i], sigma_t[extinction_row(2)][i]};
  }
  // sigma_s / sigma_t of segment i; 0 where there is nothing.
  Rgb albedo_at(std::uint32_t i) const;
  Rgb sigma_s_at(std::uint32_t i) const {
    return channels == 1 ? Rgb(sigma_s[0][i]) : Rgb{sigma_s[0][i], sigma_s[1][i], sigma_s[2][i]};
  }

 private:
  static Rgb rgb(const std::array<std::vector<double>, 3>& rows, int row_count, std::uint32_t i) {
    if (row_count == 1) return Rgb(static_cast<float>(rows[0][i]));
    return Rgb(Vec3d{rows[0][i], rows[1][i], rows[2][i]});
  }
};

// Where in its segment sample i of a march is taken, in (0, 1): random for even i, mirrored for the odd i
// after it. Each place is uniform (so the optical depth's mean is exact), what is linear over a pair cancels,
// and no period of the density is met at one phase only (docs/decisions/0002-march-jitter.md). Where not
// `paired`, each is random by itself: half as much can be wrong at worst (error_bounded_steps.h). `seed`
// names the march.
inline double jitter(std::uint32_t seed, std::uint32_t i, bool paired = true) {
  std::uint32_t h = seed + (paired ? i >> 1 : i) * 0x9e3779b9u;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h ^= h >> 16;
  const double place = (h + 0.5) * 0x1p-32;
  return paired && (i & 1) ? 1 - place : place;
}

}  // namespace tyndall::render
