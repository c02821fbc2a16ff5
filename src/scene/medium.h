// A medium as the renderer knows it: two programs and what their outputs mean.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/id.h"
#include "base/source.h"
#include "base/vec.h"
#include "optics/phase.h"
#include "vm/program/program.h"

namespace tyndall::scene {

// Bodies give no more than this; larger numbers are taken for infinite, and count as it.
inline constexpr float largest_coefficient = 1e30f;

// Indices into a program's outputs, for red, green and blue. Grey quantities name the same output three
// times.
using RgbOutputs = std::array<std::uint8_t, 3>;

// A lobe of the phase mixture. Each number is a constant, or the index of an output of the full program.
struct PhaseLobe {
  struct Number {
    float value = 0;
    std::optional<std::uint8_t> output{};  // set: read from the segment instead of `value`
  };
  optics::PhaseKind kind{};
  std::array<Number, optics::most_phase_parameters> parameters{};
  Number weight{1};
};

// A value of a medium's body that someone wants to look at: an output as it was set, or a name that the body
// defines.
struct Watched {
  std::optional<vm::Program> program{};  // of one to three components; nothing when there is no such name
  std::vector<std::string> names{};      // of all that could be looked at
};

// A number of a body as it came out of it, for reports: what of it lies out of its range is limited, and
// told. In media it is shown beside the outputs that are made of it.
struct GivenNumber {
  std::string name;  // as messages name it: "albedo", "g of hg"
  Span span;         // the statement
  double lowest = 0, highest = 0;
  std::uint8_t output = 0;                          // of `full`
  std::optional<std::uint8_t> extinction_output{};  // of `extinction`, where that is made of it
  bool scales = false;                              // a coefficient, or one's factor
  // Where several statements set it: each, and the outputs that give the number of the one that did.
  std::vector<Span> branches{};
  std::uint8_t branch_output = 0, extinction_branch_output = 0;
};

// The places at which a body asks for fields of a lattice (noise and its like), by a program of their own.
struct LatticePlaces {
  struct Field {
    std::string name;  // "fbm"
    Span span;
    std::size_t first = 0, count = 0;  // outputs
  };
  vm::Program program;
  std::vector<Field> fields;
};

// Coefficients are per metre of world space, density already multiplied in.
struct Medium {
  std::string name;
  Span definition;

  vm::Program full;  // all outputs
  RgbOutputs sigma_s{}, sigma_t{};
  std::optional<RgbOutputs> emission;  // absent: emits nothing
  std::vector<PhaseLobe> phase;        // weights sum to 1; empty when nothing scatters

  vm::Program extinction;  // sigma_t only, for transmittance: outputs are named by `extinction_sigma_t`
  RgbOutputs extinction_sigma_t{};

  std::optional<Watched> watched{};  // when asked for

  std::vector<GivenNumber> given;
  LatticePlaces lattice_places;
  // Source places of the `density`, `albedo`, … statements, for reports on bad values: one per output of
  // `full`.
  std::vector<Span> output_spans;

  // True when every coefficient is one value for the whole ray (constants, or functions of time alone).
  bool homogeneous() const;
  bool scatters() const { return !phase.empty(); }
};

using MediumId = Id<Medium>;

}  // namespace tyndall::scene
