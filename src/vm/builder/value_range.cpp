// What a value can be at least and at most, as far as its operations say so by themselves: for the ends of
// loops.
#include <algorithm>
#include <cmath>
#include <limits>

#include "vm/builder/builder.h"

namespace tyndall::vm {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Range {
  double lo = -infinite, hi = infinite;
};

// Deeper than this nothing is claimed.
constexpr int max_range_depth = 8;

Range least_of(const Range& a, const Range& b) { return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)}; }
Range largest_of(const Range& a, const Range& b) { return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)}; }

Range product_of(const Range& a, const Range& b) {
  // 0 times infinity counts as 0: an end that is not known stays unknown by another corner.
  const auto times = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
  const auto [lo, hi] =
      std::minmax({times(a.lo, b.lo), times(a.lo, b.hi), times(a.hi, b.lo), times(a.hi, b.hi)});
  return {lo, hi};
}

// Sums and products of floats are rounded.
Range rounded(const Range& r) { return {r.lo - std::fabs(r.lo) * 0x1p-23, r.hi + std::fabs(r.hi) * 0x1p-23}; }

Range range_of(const std::vector<Node>& nodes, NodeId id, int depth) {
  const Node& node = nodes[id.index];
  if (node.is_constant()) return {static_cast<double>(node.value), static_cast<double>(node.value)};
  if (!node.is_operation() || depth == max_range_depth) return {};
  const auto operand = [&](std::size_t k) { return range_of(nodes, node.operands[k], depth + 1); };
  if (op_info(node.op).has(OpTrait::fraction)) return {0, 1};
  if (node.op == Op::min) return least_of(operand(0), operand(1));
  if (node.op == Op::max) return largest_of(operand(0), operand(1));
  if (node.op == Op::clamp || node.op == Op::limit)
    return least_of(largest_of(operand(0), operand(1)), operand(2));
  if (node.op == Op::floor) return {std::floor(operand(0).lo), std::floor(operand(0).hi)};
  if (node.op == Op::ceil) return {std::ceil(operand(0).lo), std::ceil(operand(0).hi)};
  if (node.op == Op::neg) return {-operand(0).hi, -operand(0).lo};
  if (node.op == Op::add) return rounded({operand(0).lo + operand(1).lo, operand(0).hi + operand(1).hi});
  if (node.op == Op::sub) return rounded({operand(0).lo - operand(1).hi, operand(0).hi - operand(1).lo});
  if (node.op == Op::mul) return rounded(product_of(operand(0), operand(1)));
  if (node.op == Op::select)
    return {std::min(operand(1).lo, operand(2).lo), std::max(operand(1).hi, operand(2).hi)};
  return {};
}

}  // namespace

double Builder::most(NodeId id) const {
  const double most = range_of(nodes_, id, 0).hi;
  return std::isnan(most) ? infinite : most;
}

}  // namespace tyndall::vm
