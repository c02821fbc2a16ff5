// A medium along a line, and what a march of some step makes of its light in the mean.
//
// Segments take their coefficients at places that are random in mirrored pairs (render/march/march.h,
// jitter), so the mean of what is marched is a product over pairs of means over one number: known without
// chance. What it differs from the exact integral by is the bias of the step: more light comes through, and
// what is scattered at the edge of a cloud is scattered in front of it, where more light is.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall::compile {

// What a line lets through and brings: ∫ sigma_s T S and ∫ emission T, where S is light that comes in
// along the line itself (the side that is lit is the one that is seen).
struct LineLight {
  double transmitted = 0, scattered = 0, emitted = 0;
};

// Coefficients [1/m] at a place.
struct PlaceCoefficients {
  float sigma_t = 0, sigma_s = 0, emission = 0;
};

// A part of a line that is cut into `count` equal segments.
struct LinePiece {
  double t0 = 0, t1 = 0;  // [m] from the line's start
  int count = 1;
};

class LineProfile {
 public:
  // Over `length` metres: straight lines through the values at places [m] that increase, one in each of as
  // many equal parts.
  LineProfile(double length, std::span<const double> places, std::span<const PlaceCoefficients> values);

  double length() const { return length_; }
  // Exactly, and as a march has it in the mean: by pieces, between which nothing is, or at `step` [m].
  struct Compared {
    LineLight exact, marched;
    double variance = 0;  // of what one march has of the emitted light
  };
  Compared compared(std::span<const LinePiece> pieces) const;
  Compared compared(double step) const;
  double transmitted() const;
  // Where the share of what is scattered or absorbed is reached, in [0, 1) [m].
  double place_of_share(double share) const;

  // Places a segment's coefficients are averaged over, and parts in which what comes in is told apart.
  static constexpr int jitters = 8, parts = 4;

 private:
  struct Segment {
    double exact_scattered = 0, exact_emitted = 0;
    double incoming[parts] = {};  // means
  };
  PlaceCoefficients at(double t) const;
  double cumulated(const std::vector<double>& sums, double t) const;
  Segment segment(double begin, double h) const;
  void march(const LinePiece& piece, Compared& out) const;
  void pass(const Segment& segment, const PlaceCoefficients& c, double h, double& through,
            LineLight& light) const;

  double length_ = 0, apart_ = 0;  // of the line, and from one of the places at which it is kept to the next
  std::vector<PlaceCoefficients> values_;
  // From the line's start to each place: ∫ sigma_t, ∫ T, ∫ sigma_s T, ∫ emission T.
  std::vector<double> depth_, reach_, scattered_, emitted_;
};

}  // namespace tyndall::compile
