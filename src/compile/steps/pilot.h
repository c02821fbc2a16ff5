// Runs media along lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/steps/line_profile.h"
#include "compile/steps/pilot_lines.h"
#include "vm/run/machine.h"

namespace tyndall::compile {

class Pilot {
 public:
  explicit Pilot(const CompiledScene& world) : world_(world) {}

  // Each line with one look in each of so many equal parts of it.
  std::vector<LineProfile> profiles(const std::vector<PilotLine>& lines, std::size_t places);

 private:
  LineProfile profile(const PilotLine& line, std::size_t places, std::uint64_t number);
  void evaluate(const PilotLine& line, const CompiledVolume& volume, const CompiledMedium& medium);

  const CompiledScene& world_;
  vm::Machine machine_;
  std::uint64_t number_ = 0;
  std::vector<double> places_;
  std::vector<PlaceCoefficients> values_;
  std::array<std::vector<float>, 6> inputs_;  // p, P
  std::vector<float> outputs_;
};

}  // namespace tyndall::compile
