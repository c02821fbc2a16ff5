// What a pilot learned of the lights of one region of space: how likely each part of the light tree is to be
// chosen there. After Vévoda, Kondapaneni and Křivánek, "Bayesian online regression for adaptive direct
// illumination sampling" (SIGGRAPH 2018), whose clusters of lights are chosen by the second moment of what
// they bring; here all is learned before rendering begins (decision 37).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "compile/lights/light_tree.h"
#include "optics/light_bounds.h"

namespace tyndall::render {

// A cut of the light tree: every light of the tree is below one of its parts. No light that may reach a place
// has the weight 0 there, whatever the pilot saw.
struct LightRegion {
  struct Part {
    std::uint32_t node = 0, first_leaf = 0;
    double ratio = 0;   // of what it brings to what its bounds promise: the root of its mean square
    double fixed = 0;   // what it weighs everywhere in the region; 0: the ratio times the importance
    double before = 0;  // the sum of the fixed weights before it
    // What the importance of lights that shine to all sides is made of; no intensity: others are among them.
    Vec3d center{};
    double radius = 0, intensity = 0;
  };
  // What a part weighs for a segment where that is not fixed.
  static double weight(const compile::LightTree& tree, const Part& part, const optics::RaySegment& segment);
  std::vector<Part> parts;          // in the order of their leaves
  std::vector<std::uint32_t> near;  // those whose weight is not fixed
  double fixed = 0;                 // sum of the fixed weights
  std::vector<double> others;       // ratios of LightTree::others()
  Vec3d lo, hi;                     // a box around the places that were looked at: here the weights hold

  bool holds(const optics::RaySegment& segment) const;
  const Part& part_of(std::uint32_t leaf) const;
  // For a number below `fixed`.
  const Part& fixed_part(double at) const;
};

// What one light brought to a place: of the tree's drawn by it, of the others as often as comes.
struct LightTrial {
  std::uint32_t place = 0;
  std::uint32_t light = 0;  // of the tree; of the others the place in their list
  bool in_tree = true;
  double brought = 0;     // as irradiance, with what is hidden and absorbed
  double importance = 0;  // of one of the others
};

// Makes regions; keeps its memory from one to the next.
class RegionLearner {
 public:
  explicit RegionLearner(const compile::LightTree& tree) : tree_(&tree), sums_(tree.node_count()) {}

  // `places`: points in the region, as segments of no length.
  LightRegion learn(std::span<const optics::RaySegment> places, std::span<const LightTrial> trials);

 private:
  // Of a ratio: estimates of its mean and mean square.
  struct Moments {
    double mean = 1, square = 1;
  };
  struct Sums {
    double count = 0, mean = 0, square = 0;

    void add(double ratio) { ++count, mean += ratio, square += ratio * ratio; }
    Moments after(const Moments& prior) const;
  };
  struct Candidate {
    std::uint32_t node = 0;
    Moments moments;
    double importance = 0;  // mean over the places
    // What dividing it may save at most.
    double worth() const;
  };
  void add(const optics::RaySegment& place, const LightTrial& trial);
  Candidate candidate(std::uint32_t node, std::span<const optics::RaySegment> places) const;
  std::vector<Candidate> cut(std::span<const optics::RaySegment> places) const;
  LightRegion::Part part(const Candidate& candidate, double least_ratio, const Vec3d& center,
                         double radius) const;

  const compile::LightTree* tree_;
  std::vector<Sums> sums_;  // of nodes
  std::vector<std::uint32_t> touched_;
};

}  // namespace tyndall::render
