// Value numbering and folding: what happens to a value when it is made.
#include "vm/builder/builder.h"

#include <algorithm>
#include <bit>

#include "base/check.h"
#include "vm/run/machine.h"

namespace tyndall::vm {

namespace {

std::uint64_t combine(std::uint64_t hash, std::uint64_t value) {
  return (hash ^ value) * 0x9e3779b97f4a7c15u + (hash >> 29);
}

bool is_commutative(Op op) {
  return op == Op::add || op == Op::mul || op == Op::equal || op == Op::not_equal || op == Op::logical_and ||
         op == Op::logical_or;
}

}  // namespace

NodeId Builder::constant(float value) {
  Node node{};
  node.kind = Node::Kind::constant;
  node.uniform = true;
  node.value = value;
  return add(node);
}

NodeId Builder::input(Input input) {
  Node node{};
  node.kind = Node::Kind::input;
  node.uniform = vm::is_uniform(input);
  node.input = input;
  return add(node);
}

std::uint32_t Builder::plane(const PlanePointer& plane) {
  CHECK(plane != nullptr);
  return index_in(tables_.planes, plane);
}
std::uint32_t Builder::voxels(const VoxelsPointer& voxels) {
  CHECK(voxels != nullptr);
  return index_in(tables_.voxels, voxels);
}

NodeId Builder::emit(Op op, std::span<const NodeId> operands, Span span, std::uint8_t count,
                     std::uint32_t immediate) {
  CHECK_EQ(operands.size(), static_cast<std::size_t>(op_info(op).operands));
  Node node{};
  node.kind = Node::Kind::operation;
  node.op = op;
  node.count = count;
  node.immediate = immediate;
  node.span = span;
  node.uniform = true;
  bool all_constant = true;
  for (std::size_t k = 0; k < operands.size(); ++k) {
    CHECK_LT(operands[k].index, nodes_.size());
    node.operands[k] = operands[k];
    node.uniform = node.uniform && is_uniform(operands[k]);
    all_constant = all_constant && is_constant(operands[k]);
  }
  if (!fold_) return add(node);
  if (all_constant) {
    std::array<float, 4> values{};
    for (std::size_t k = 0; k < operands.size(); ++k) values[k] = constant_value(operands[k]);
    return constant(evaluate_lane(op, std::span(values.data(), operands.size()), count, immediate, tables_));
  }
  if (const std::optional<Simpler> found = simpler(nodes_, node)) {
    if (found->constant) return constant(*found->constant);
    if (found->value.valid()) return found->value;
    std::array<NodeId, 3> instead = found->operands;
    if (found->second) instead[1] = constant(*found->second);
    return emit(found->op, std::span(instead).first(static_cast<std::size_t>(op_info(found->op).operands)),
                span);
  }
  if (is_commutative(op) && node.operands[1] < node.operands[0])
    std::swap(node.operands[0], node.operands[1]);
  return add(node);
}

bool Builder::is_constant(NodeId id) const { return nodes_[id.index].is_constant(); }

float Builder::constant_value(NodeId id) const {
  CHECK(is_constant(id));
  return nodes_[id.index].value;
}

bool Builder::is_uniform(NodeId id) const { return nodes_[id.index].uniform; }

std::vector<Builder::LatticeField> Builder::lattice_fields(std::span<const NodeId> outputs) const {
  const Graph graph(nodes_, outputs);
  std::vector<LatticeField> out;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const Node& node = graph.nodes[i];
    if (graph.uses[i] == 0 || !node.is_operation() || !op_info(node.op).has(OpTrait::lattice)) continue;
    LatticeField field{node.op, node.span, {node.reads().begin(), node.reads().end()}};
    const bool again = std::any_of(out.begin(), out.end(),
                                   [&](const LatticeField& other) { return other.place == field.place; });
    if (!again) out.push_back(std::move(field));
  }
  return out;
}

NodeId Builder::add(const Node& node) {
  const auto key = [](const Node& n) {
    std::uint64_t hash = combine(static_cast<std::uint64_t>(n.kind), static_cast<std::uint64_t>(n.op));
    hash = combine(hash, std::uint64_t{n.count} << 32 | n.immediate);
    hash = combine(
        hash, std::uint64_t{std::bit_cast<std::uint32_t>(n.value)} << 8 | static_cast<unsigned>(n.input));
    for (const NodeId operand : n.operands) hash = combine(hash, operand.index);
    return hash;
  };
  const auto equal = [](const Node& a, const Node& b) {
    return a.kind == b.kind && a.op == b.op && a.count == b.count && a.immediate == b.immediate &&
           a.input == b.input && a.operands == b.operands &&
           std::bit_cast<std::uint32_t>(a.value) == std::bit_cast<std::uint32_t>(b.value);
  };
  const std::uint64_t hash = key(node);
  if (fold_ || node.kind != Node::Kind::operation) {
    const auto [begin, end] = by_hash_.equal_range(hash);
    for (auto it = begin; it != end; ++it)
      if (equal(nodes_[it->second.index], node)) return it->second;
  }
  const NodeId id(nodes_.size());
  nodes_.push_back(node);
  by_hash_.emplace(hash, id);
  return id;
}

}  // namespace tyndall::vm
