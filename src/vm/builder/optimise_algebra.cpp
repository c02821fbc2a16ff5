// Pass: algebra that is exact in floating point, whatever the other operands hold: infinities, NaN, zeros of
// either sign. docs/shaders.md says what is not done because it is not exact. NaNs count as one.
#include <bit>
#include <cmath>

#include "vm/builder/graph.h"

namespace tyndall::vm {

namespace {

// 0 or 1, never NaN.
bool is_boolean_op(Op op) {
  return op == Op::less || op == Op::less_equal || op == Op::equal || op == Op::not_equal ||
         op == Op::logical_and || op == Op::logical_or || op == Op::logical_not;
}

class Algebra {
 public:
  Algebra(const std::vector<Node>& nodes, const Node& node)
      : nodes_(nodes), node_(node), a_(node.operands[0]), b_(node.operands[1]), c_(node.operands[2]) {}

  std::optional<Simpler> run() const {
    if (node_.op == Op::copy) return same(a_);
    if (const std::optional<Simpler> found = sums()) return found;
    if (const std::optional<Simpler> found = products()) return found;
    if (const std::optional<Simpler> found = choices()) return found;
    return logic();
  }

 private:
  static Simpler same(NodeId id) { return {.value = id}; }
  static Simpler constant(float v) { return {.constant = v}; }
  static Simpler other(Op op, NodeId a, NodeId b = {}, NodeId c = {}) {
    return {.op = op, .operands = {a, b, c}};
  }

  bool is(NodeId id, float value) const {
    const Node& node = nodes_[id.index];
    return node.is_constant() &&
           std::bit_cast<std::uint32_t>(node.value) == std::bit_cast<std::uint32_t>(value);
  }
  bool is_op(NodeId id, Op op) const {
    const Node& node = nodes_[id.index];
    return node.is_operation() && node.op == op;
  }
  NodeId inside(NodeId id) const { return nodes_[id.index].operands[0]; }
  bool is_boolean(NodeId id) const {
    return nodes_[id.index].is_operation() && is_boolean_op(nodes_[id.index].op);
  }

  std::optional<Simpler> sums() const {
    if (node_.op == Op::sub && is(b_, 0.0f)) return same(a_);
    if (node_.op == Op::add && is(b_, -0.0f)) return same(a_);
    if (node_.op == Op::add && is(a_, -0.0f)) return same(b_);
    if (node_.op == Op::neg && is_op(a_, Op::neg)) return same(inside(a_));
    if (node_.op == Op::add && is_op(b_, Op::neg)) return other(Op::sub, a_, inside(b_));
    if (node_.op == Op::add && is_op(a_, Op::neg)) return other(Op::sub, b_, inside(a_));
    if (node_.op == Op::sub && is_op(b_, Op::neg)) return other(Op::add, a_, inside(b_));
    if (node_.op == Op::abs && (is_op(a_, Op::neg) || is_op(a_, Op::abs))) return other(Op::abs, inside(a_));
    return std::nullopt;
  }

  std::optional<Simpler> products() const {
    if (node_.op == Op::mul && is(b_, 1.0f)) return same(a_);
    if (node_.op == Op::mul && is(a_, 1.0f)) return same(b_);
    if (node_.op == Op::mul && is(b_, -1.0f)) return other(Op::neg, a_);
    if (node_.op == Op::mul && is(a_, -1.0f)) return other(Op::neg, b_);
    if (node_.op == Op::mul && is_op(a_, Op::neg) && is_op(b_, Op::neg))
      return other(Op::mul, inside(a_), inside(b_));
    if (node_.op != Op::div) return std::nullopt;
    if (is(b_, 1.0f)) return same(a_);
    // A power of two whose reciprocal is a normal number: both round the same exact value.
    const Node& divisor = nodes_[b_.index];
    int exponent = 0;
    if (divisor.is_constant() && std::isfinite(divisor.value) &&
        std::fabs(std::frexp(divisor.value, &exponent)) == 0.5f && exponent >= -126 && exponent <= 127)
      return Simpler{.op = Op::mul, .operands = {a_, {}, {}}, .second = 1 / divisor.value};
    return std::nullopt;
  }

  std::optional<Simpler> choices() const {
    if ((node_.op == Op::min || node_.op == Op::max) && a_ == b_) return same(a_);
    if (node_.op == Op::mix && is(c_, 1.0f)) return same(b_);
    if (node_.op != Op::select) return std::nullopt;
    if (b_ == c_) return same(b_);
    if (nodes_[a_.index].is_constant()) return same(nodes_[a_.index].value != 0 ? b_ : c_);
    if (is_op(a_, Op::logical_not)) return other(Op::select, inside(a_), c_, b_);
    // A choice by the same condition inside of a branch is made already.
    if (is_op(b_, Op::select) && inside(b_) == a_)
      return other(Op::select, a_, nodes_[b_.index].operands[1], c_);
    if (is_op(c_, Op::select) && inside(c_) == a_)
      return other(Op::select, a_, b_, nodes_[c_.index].operands[2]);
    return std::nullopt;
  }

  std::optional<Simpler> logic() const {
    if (node_.op == Op::logical_not && is_op(a_, Op::logical_not) && is_boolean(inside(a_)))
      return same(inside(a_));
    if (node_.op != Op::logical_and && node_.op != Op::logical_or) return std::nullopt;
    const bool deciding = node_.op == Op::logical_or;  // the operand that settles the matter
    for (const auto& [known, rest] : {std::pair{a_, b_}, std::pair{b_, a_}}) {
      if (!nodes_[known.index].is_constant()) continue;
      if ((nodes_[known.index].value != 0) == deciding) return constant(deciding ? 1.0f : 0.0f);
      if (is_boolean(rest)) return same(rest);
    }
    if (a_ == b_ && is_boolean(a_)) return same(a_);
    return std::nullopt;
  }

  const std::vector<Node>& nodes_;
  const Node& node_;
  NodeId a_, b_, c_;
};

}  // namespace

std::optional<Simpler> simpler(const std::vector<Node>& nodes, const Node& node) {
  return Algebra(nodes, node).run();
}

}  // namespace tyndall::vm
