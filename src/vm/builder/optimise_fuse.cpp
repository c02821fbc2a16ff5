// Pass: a sum, difference or product of which one side has no other reader becomes one instruction. It rounds
// after each of its operations, so no bit changes; what is saved is a store and a load of a whole row.
#include <initializer_list>

#include "vm/builder/graph.h"

namespace tyndall::vm {

namespace {

class Fusion {
 public:
  explicit Fusion(Graph& graph) : graph_(graph) {}

  void run() {
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      Node& node = graph_.nodes[i];
      if (graph_.uses[i] == 0 || !node.is_operation()) continue;
      if (node.op == Op::add || node.op == Op::sub)
        fuse_products(node);
      else if (node.op == Op::mul)
        fuse_sum(node);
    }
  }

 private:
  // The node of the operand when it is `op` and may melt into its only reader, else nothing.
  const Node* part(const Node& reader, std::size_t operand, Op op) const {
    const NodeId id = reader.operands[operand];
    const Node& node = graph_[id];
    const bool fits =
        node.is_operation() && node.op == op && graph_.uses[id.index] == 1 && node.uniform == reader.uniform;
    return fits ? &node : nullptr;
  }

  void replace(Node& node, Op op, std::array<NodeId, 4> operands, std::initializer_list<NodeId> melted) {
    for (const NodeId id : melted) graph_.uses[id.index] = 0;
    node.op = op;
    node.operands = operands;
  }

  // a*b + c, a*b - c, c - a*b, a*b + c*d
  void fuse_products(Node& node) {
    const bool add = node.op == Op::add;
    const NodeId left = node.operands[0], right = node.operands[1];
    const Node* const a = part(node, 0, Op::mul);
    const Node* const b = part(node, 1, Op::mul);
    if (a && b && add)
      replace(node, Op::dot2, {a->operands[0], a->operands[1], b->operands[0], b->operands[1]},
              {left, right});
    else if (a)
      replace(node, add ? Op::fma : Op::fms, {a->operands[0], a->operands[1], right, NodeId{}}, {left});
    else if (b)
      replace(node, add ? Op::fma : Op::fnma, {b->operands[0], b->operands[1], left, NodeId{}}, {right});
  }

  // (a + b)*c, (a - b)*c
  void fuse_sum(Node& node) {
    for (const std::size_t k : {0u, 1u})
      for (const Op op : {Op::add, Op::sub})
        if (const Node* const sum = part(node, k, op)) {
          replace(node, op == Op::add ? Op::add_mul : Op::sub_mul,
                  {sum->operands[0], sum->operands[1], node.operands[1 - k], NodeId{}}, {node.operands[k]});
          return;
        }
  }

  Graph& graph_;
};

}  // namespace

void fuse(Graph& graph) { Fusion(graph).run(); }

}  // namespace tyndall::vm
