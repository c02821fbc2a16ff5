// Decoupled marching (Kulla and Fajardo, EGSR 2012, section 3): one ray's volumes, split into segments,
// evaluated as one batch. Inside a segment the medium is constant and every integral exact; light can then be
// taken at any t, by any density.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "base/interval.h"
#include "base/numerics.h"
#include "base/vec.h"
#include "compile/compiled_scene.h"
#include "optics/phase.h"
#include "render/segment_limit.h"
#include "render/stretches.h"

namespace tyndall::render {

struct Worker;

// A stretch of the ray in which the same volumes are active; segments [first, first + count).
struct Region {
  Intervald t;
  std::uint32_t first = 0, count = 0;
  bool scatters = false;
};

// One volume's stay over segments [first, first + count): the outputs of its medium's program, row by row in
// March::pool. A homogeneous medium has rows of one value.
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
  std::uint32_t laid = 0;         // segments in all
  std::uint32_t before_dark = 0;  // of them, before chance may end the march for the first time (dark.h)
  std::uint32_t round_end = 0;    // up to which they are evaluated now
  std::uint32_t blocks = 0;       // evaluated: the first ones
  std::array<std::size_t, 3> crossings{};  // that the sums went over, by channel
  Vec3d emitted;                           // so far
};

// Segments of one ray, structure of arrays; a colour quantity has one row when no medium of the scene is
// chromatic. Edges increase; transmittance rises only where a march goes on in the dark.
struct March {
  compile::Ray ray;
  int channels = 1, extinction_channels = 1;
  std::uint32_t count = 0;     // of segments; a march that ended in the dark has fewer than were laid
  std::vector<double> t0, dt;  // [m]
  std::array<std::vector<float>, 3> sigma_s, sigma_t, emission;  // [1/m], [1/m], [W/m³/sr]
  std::array<std::vector<double>, 3>
      transmittance;                             // at the start of each segment; [count]: at the ray's end
  std::array<std::vector<double>, 3> scattered;  // ∫ sigma_s T from the ray's start to each segment's start
  Rgb emitted;                                   // ∫ emission T over the whole ray
  std::vector<Region> regions;
  std::vector<Block> blocks;
  const float* pool = nullptr;                     // the worker's: holds until its next march
  std::vector<Intervald> scattering_stretches;     // of the regions that scatter
  std::vector<Stretch> stretches;                  // of a march
  std::vector<compile::VolumeInterval> intervals;  // of a flight
  std::vector<MarchCrossing> crossings;            // in order of t; given by who asks for the march
  MarchProgress progress;

  bool scatters() const { return !scattering_stretches.empty(); }
  Rgb end_transmittance() const { return rgb(transmittance, extinction_channels, count); }
  Rgb total_scattered() const { return rgb(scattered, channels, count); }
  // Of the whole ray, mean of the channels; does not underflow as transmittance does.
  double optical_depth() const;
  // The row of extinction and transmittance that serves channel c.
  int extinction_row(int c) const { return extinction_channels == 1 ? 0 : c; }
  // Output k of a block at a segment that it holds.
  float output(const Block& block, std::size_t k, std::uint32_t segment) const {
    return pool[block.rows + k * block.pitch + (block.row_length == 1 ? 0 : segment - block.first)];
  }
  // The segment that holds t (of a region; the nearest one for a t in a gap by rounding).
  std::uint32_t segment_at(double t) const;
  // Transmittance from the ray's start to t, inside segment i.
  Vec3d transmittance_at(std::uint32_t i, double t) const;
  MarchPlace place_at(double t) const {
    const std::uint32_t i = segment_at(t);
    return {t, i, transmittance_at(i, t)};
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
// and no period of the density is met at one phase only (docs/decisions/0002-march-jitter.md). `seed` names
// the march.
inline double jitter(std::uint32_t seed, std::uint32_t i) {
  std::uint32_t h = seed + (i >> 1) * 0x9e3779b9u;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h ^= h >> 16;
  const double place = (h + 0.5) * 0x1p-32;
  return i & 1 ? 1 - place : place;
}

// A ray to be marched over [0, ray.t_max): intervals, segments, programs, running sums.
struct MarchRequest {
  compile::Ray ray;
  compile::RayKind kind{};
  std::uint32_t seed = 0;  // of its jitter
  March* out = nullptr;
  bool may_end_dark = false;  // by chance, where little passes (dark.h)
};

// A block of a request, sorted by medium: its place among the lanes of a batch.
struct MarchBatchEntry {
  std::uint32_t medium = 0, request = 0, block = 0;
  auto operator<=>(const MarchBatchEntry&) const = default;
};

// Marches rays together: the segments of all are the lanes of one batch for each medium.
void march(const compile::CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker);
// One ray alone.
void march(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
           std::uint32_t seed, Worker& worker, March& out);

// Coefficients at points instead: the segments are the t0 that each request's march holds already, in order
// and of no length, as are its ray and its intervals. Nothing is summed along the ray.
void evaluate_points(const compile::CompiledScene& world, std::span<const MarchRequest> requests,
                     Worker& worker);

// Distances distributed as scattered radiance: per channel discrete over segments and exponential inside,
// channels mixed in proportion to throughput times ∫ sigma_s T (transport §3, "Density").
class DensityDistribution {
 public:
  DensityDistribution(const March& march, const Rgb& throughput);
  bool available() const { return total_ > 0; }
  MarchPlace sample(float u_channel, float u) const;
  // Per metre.
  double pdf(const MarchPlace& at) const;

 private:
  const March& march_;
  std::array<double, 3> share_{};  // of the channels; sums to 1
  double total_ = 0;
};

// The phase function at one segment: lobes of all active media, weighted by their scattering.
class PhaseMixture {
 public:
  void set(const compile::CompiledScene& world, const March& march, std::uint32_t segment);
  // Colour because media of different colours may scatter differently: ∑ (sigma_s share) * lobe [1/sr].
  Rgb eval(float one_minus_cos) const;
  // The same with every lobe less directed (optics::Phase::eval_softened).
  Rgb eval_softened(float one_minus_cos, float anisotropy) const;
  float pdf(float one_minus_cos) const;
  // Draws 1 - cos.
  float sample(float u_lobe, float u0, float u1) const;

 private:
  struct Lobe {
    optics::Phase phase;
    Rgb share;  // of sigma_s, per channel; sums to 1 over the lobes
    float probability;
  };
  std::vector<Lobe> lobes_;
  // Whose lobes these are, for ever; null: they are of one place.
  const scene::Medium* kept_medium_ = nullptr;
};

}  // namespace tyndall::render
