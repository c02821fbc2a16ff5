// Free paths: the methods `tracking` and `stochastic` follow a ray to one point, instead of keeping the whole
// of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "render/march/march.h"

namespace tyndall::render {

// Upper bounds of extinction along a ray, of all volumes together: majorant[i] over [edges[i], edges[i + 1]).
struct MajorantLine {
  std::vector<double> edges;
  std::vector<double> majorant;  // [1/m]
};

// Where a ray went, and with what weights. Densities are of the path with its null collisions, as all
// strategies share them (Miller, Georgiev and Jarosz 2019).
struct FreePath {
  bool collided = false;  // scattered at t
  bool stopped = false;   // by a surface that lets only a part through; with neither it reached the ray's end
  double t = 0;
  Rgb weight;          // of what is scattered (sigma_s in it), or of what reaches the end
  double density = 0;  // of the collision [1/m]

  bool ended() const { return collided || stopped; }

  // A point chosen before the path is sampled, towards a light: what is scattered there, and the density with
  // which a path over the same null collisions would have collided there.
  std::optional<double> aimed_t;
  Rgb aimed_weight;
  double aimed_density = 0;

  // On the way.
  MajorantLine line;
  std::vector<double> candidate_majorant;
  double cursor = 0;          // how far the candidates have come
  std::uint32_t counter = 0;  // of random numbers
  std::size_t crossing = 0;   // the next surface on the way
  Vec3d through;              // weights when every candidate so far was null
  double null_probability = 1;
  Vec3d aimed_through;  // transmittance estimated by ratio tracking, up to the aimed point
  Vec3d aimed_weights;  // `through` there
  double aimed_null_probability = 1;
  double aimed_boost = 1;  // of roulette
};

// Samples a free path up to a drawn optical depth of a march (Lafortune and Willems 1996), for two numbers in
// [0, 1).
void sample_free_path(March& march, const Rgb& throughput, float u_channel, float u, FreePath& free_path);

// Makes the march's totals what the free path found: all is scattered at one point, or all goes through.
void set_totals(const FreePath& free_path, March& march);

}  // namespace tyndall::render
