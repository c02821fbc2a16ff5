// The graph of values that a Builder collects, and the passes over the part of it that becomes a program.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/id.h"
#include "base/source.h"
#include "vm/program/op.h"
#include "vm/program/program.h"

namespace tyndall::vm {

using NodeId = Id<struct NodeTag>;

struct Node {
  enum class Kind : std::uint8_t { constant, input, operation } kind;
  Op op{};
  std::uint8_t count = 0;
  bool uniform = false;  // one value for all lanes
  Input input{};
  float value = 0;
  std::uint32_t immediate = 0;
  std::array<NodeId, 4> operands{};
  Span span;

  bool is_operation() const { return kind == Kind::operation; }
  bool is_constant() const { return kind == Kind::constant; }
  // An operation that is computed for every lane.
  bool is_lane() const { return is_operation() && !uniform; }
  std::span<const NodeId> reads() const {
    return std::span(operands).first(is_operation() ? static_cast<std::size_t>(op_info(op).operands) : 0);
  }
};

// What some outputs are made of. Operands stand before their readers.
struct Graph {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> uses;  // readers of each node, outputs among them; 0: dead
  std::vector<NodeId> outputs;

  // Counts the readers of every value that the outputs need; the others have none.
  Graph(std::vector<Node> all, std::span<const NodeId> wanted);
  const Node& operator[](NodeId id) const { return nodes[id.index]; }
};

// optimise_algebra.cpp: an operation that gives the same bits for less. Either the value itself, or another
// operation for it.
struct Simpler {
  NodeId value{};
  Op op{};
  std::array<NodeId, 3> operands{};  // of `op`, when there is no value
  std::optional<float> second{};     // a constant that stands for operands[1]
  std::optional<float> constant{};   // the value, when it is known
};
std::optional<Simpler> simpler(const std::vector<Node>& nodes, const Node& node);

// optimise_fuse.cpp: pairs of operations that are one instruction.
void fuse(Graph& graph);

// optimise_guard.cpp: the order in which lane values are computed, and which of them some lanes do without.
struct Schedule {
  struct Guard {
    std::uint32_t first, last;  // of `order`, half-open
    NodeId condition;
    bool when;
  };
  std::vector<NodeId> order;
  std::vector<Guard> guards;  // outer ones before inner ones
};
Schedule schedule(const Graph& graph, bool guards);

}  // namespace tyndall::vm
