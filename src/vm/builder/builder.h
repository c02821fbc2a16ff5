// Builds a Program from a graph of values. Equal values are made once (value numbering), constant ones are
// folded by running the kernels, unused ones are dropped, rows are reused once their last reader has run;
// graph.h lists the other passes.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/id.h"
#include "vm/builder/graph.h"
#include "vm/program/op.h"
#include "vm/program/program.h"

namespace tyndall::vm {

class Builder {
 public:
  // With folding off every operation is kept, for tests that compare the two. A constant is still a constant.
  // Without guards every lane computes everything.
  explicit Builder(bool fold = true, bool guards = true) : fold_(fold), guards_(guards) {}

  NodeId constant(float value);
  NodeId input(Input input);
  // The immediate of operations that look up in this.
  std::uint32_t plane(const PlanePointer& plane);
  std::uint32_t voxels(const VoxelsPointer& voxels);
  // The value of `op` on the operands; `span` is kept for listings. Operand count must be the op's.
  NodeId emit(Op op, std::span<const NodeId> operands, Span span, std::uint8_t count = 0,
              std::uint32_t immediate = 0);
  NodeId emit(Op op, std::initializer_list<NodeId> operands, Span span, std::uint8_t count = 0,
              std::uint32_t immediate = 0) {
    return emit(op, std::span(operands.begin(), operands.size()), span, count, immediate);
  }

  bool is_constant(NodeId id) const;
  float constant_value(NodeId id) const;  // only of constants
  // A number that the node never exceeds (NaN aside), for the ends of loops; infinite where none is easily
  // seen.
  double most(NodeId id) const;
  // True when the node has one value for all lanes (constants, time, and what is made of them).
  bool is_uniform(NodeId id) const;

  // The fields of a lattice (noise and its like, checker) among what `outputs` are made of, each with its
  // place; those at equal places once.
  struct LatticeField {
    Op op{};
    Span span;
    std::vector<NodeId> place;
  };
  std::vector<LatticeField> lattice_fields(std::span<const NodeId> outputs) const;

  // The program that computes exactly `outputs`, in that order. May be called several times with different
  // outputs (density only; everything). The result satisfies verify(). Programs over the limits of the
  // encoding (65,535 operands) are reported by an empty optional.
  std::optional<Program> finish(std::span<const NodeId> outputs) const;

 private:
  NodeId add(const Node& node);

  bool fold_, guards_;
  std::vector<Node> nodes_;
  Tables tables_;
  std::unordered_multimap<std::uint64_t, NodeId> by_hash_;
};

}  // namespace tyndall::vm
