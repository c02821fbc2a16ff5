// Pass: what only one side of a choice needs is computed where that side is taken. Operations whose every
// reader is, in the end, one branch of selects with the same condition form a block; blocks nest as choices
// do. A block that costs more than looking at its condition gets a guard. The code stays straight: whoever
// ignores guards computes the same outputs, for a select passes on nothing of the branch that it does not
// take.
#include <algorithm>
#include <map>
#include <set>

#include "base/check.h"
#include "vm/builder/graph.h"

namespace tyndall::vm {

namespace {

// A guard costs about as much as this many nanoseconds a lane: the look at the condition, and shorter loops.
constexpr double guard_cost = 0.4;
// Choices inside of choices beyond this depth get no guards of their own.
constexpr std::uint32_t max_guard_depth = 32;

using BlockId = std::uint32_t;
constexpr BlockId whole = 0;  // what all lanes compute

struct Block {
  BlockId parent = whole;
  std::uint32_t depth = 0;
  NodeId condition;
  bool when = true;
  double cost = 0;                  // of its operations and of the blocks in it
  std::size_t last = 0;             // the greatest index of those operations
  std::set<std::size_t> ready;      // operations of its own whose operands are there
  std::set<std::size_t> all_ready;  // these and those of the blocks in it
};

// Finds each operation's block.
class Blocks {
 public:
  explicit Blocks(const Graph& graph) : graph_(graph), block_of_(graph.nodes.size(), unknown) {
    blocks_.emplace_back();
    for (const NodeId output : graph.outputs) block_of_[output.index] = whole;
    for (std::size_t i = graph.nodes.size(); i-- > 0;) {
      const Node& node = graph.nodes[i];
      if (graph.uses[i] == 0 || !node.is_operation()) continue;
      if (!node.is_lane()) block_of_[i] = whole;
      CHECK(block_of_[i] != unknown);
      visit(node, block_of_[i]);
    }
    drop_cheap();
  }

  std::vector<Block>& blocks() { return blocks_; }
  BlockId operator[](NodeId id) const { return block_of_[id.index]; }

 private:
  static constexpr BlockId unknown = 0xffffffffu;

  void visit(const Node& node, BlockId block) {
    const auto reads = node.reads();
    for (std::size_t k = 0; k < reads.size(); ++k) {
      const bool branch = node.op == Op::select && k > 0 && reads[1] != reads[2];
      const BlockId needed_in = branch ? child(block, reads[0], k == 1) : block;
      BlockId& of_operand = block_of_[reads[k].index];
      of_operand = of_operand == unknown ? needed_in : common(of_operand, needed_in);
    }
  }

  // The block inside `parent` where the condition holds (or does not); `parent` itself when that is settled.
  BlockId child(BlockId parent, NodeId condition, bool when) {
    if (blocks_[parent].depth == max_guard_depth) return parent;
    for (BlockId b = parent; b != whole; b = blocks_[b].parent)
      if (blocks_[b].condition == condition) return parent;
    const auto [found, added] =
        by_condition_.try_emplace({parent, condition.index, when}, static_cast<BlockId>(blocks_.size()));
    if (added) {
      Block& block = blocks_.emplace_back();
      block.parent = parent;
      block.depth = blocks_[parent].depth + 1;
      block.condition = condition;
      block.when = when;
    }
    return found->second;
  }
  BlockId common(BlockId a, BlockId b) const {
    while (a != b)
      (blocks_[a].depth >= blocks_[b].depth ? a : b) =
          blocks_[blocks_[a].depth >= blocks_[b].depth ? a : b].parent;
    return a;
  }

  // Operations of blocks that a guard would not pay for are computed where the block stands.
  void drop_cheap() {
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      const Node& node = graph_.nodes[i];
      if (graph_.uses[i] == 0 || !node.is_lane()) continue;
      for (BlockId b = block_of_[i]; b != whole; b = blocks_[b].parent)
        blocks_[b].cost += op_cost(node.op, node.count);
    }
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      if (graph_.uses[i] == 0 || !graph_.nodes[i].is_lane()) continue;
      BlockId& b = block_of_[i];
      while (b != whole && blocks_[b].cost < guard_cost) b = blocks_[b].parent;
      for (BlockId outer = b; outer != whole; outer = blocks_[outer].parent) blocks_[outer].last = i;
    }
  }

  const Graph& graph_;
  std::vector<BlockId> block_of_;
  std::vector<Block> blocks_;
  std::map<std::tuple<BlockId, std::uint32_t, bool>, BlockId> by_condition_;
};

// Puts the operations in an order in which blocks stand together and operands before readers, as near to the
// order of the graph as that allows: the earlier a value's last reader, the sooner its row is free.
class Scheduler {
 public:
  explicit Scheduler(const Graph& graph)
      : graph_(graph), blocks_(graph), waits_for_(graph.nodes.size(), 0), readers_(graph.nodes.size()) {
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      if (graph.uses[i] == 0 || !graph.nodes[i].is_lane()) continue;
      for (const NodeId id : graph.nodes[i].reads()) wait_for(i, id);
      for (BlockId b = blocks_[NodeId(i)]; b != whole; b = blocks_.blocks()[b].parent)
        wait_for(i, blocks_.blocks()[b].condition);
      if (waits_for_[i] == 0) set_ready(i, true);
    }
  }

  Schedule run() {
    run_block(whole);
    return std::move(schedule_);
  }

 private:
  void wait_for(std::size_t i, NodeId id) {
    if (!graph_[id].is_lane()) return;
    ++waits_for_[i];
    readers_[id.index].push_back(i);
  }

  void set_ready(std::size_t i, bool ready) {
    std::vector<Block>& blocks = blocks_.blocks();
    const BlockId own = blocks_[NodeId(i)];
    const auto change = [&](std::set<std::size_t>& set) { ready ? void(set.insert(i)) : void(set.erase(i)); };
    change(blocks[own].ready);
    for (BlockId b = own;; b = blocks[b].parent) {
      change(blocks[b].all_ready);
      if (b == whole) return;
    }
  }

  void run_block(BlockId id) {
    std::vector<Block>& blocks = blocks_.blocks();
    while (!blocks[id].all_ready.empty()) {
      const std::size_t next = *blocks[id].all_ready.begin();
      BlockId inner = blocks_[NodeId(next)];
      if (inner == id) {
        emit(next);
        continue;
      }
      while (blocks[inner].parent != id) inner = blocks[inner].parent;
      // What the block may read of this one comes first, so that it need not be opened again.
      while (!blocks[id].ready.empty() && *blocks[id].ready.begin() < blocks[inner].last)
        emit(*blocks[id].ready.begin());
      const auto guard = schedule_.guards.size();
      const auto first = static_cast<std::uint32_t>(schedule_.order.size());
      schedule_.guards.push_back({first, first, blocks[inner].condition, blocks[inner].when});
      run_block(inner);
      schedule_.guards[guard].last = static_cast<std::uint32_t>(schedule_.order.size());
    }
  }

  void emit(std::size_t i) {
    set_ready(i, false);
    schedule_.order.emplace_back(i);
    for (const std::size_t reader : readers_[i])
      if (--waits_for_[reader] == 0) set_ready(reader, true);
  }

  const Graph& graph_;
  Blocks blocks_;
  std::vector<std::uint32_t> waits_for_;
  std::vector<std::vector<std::size_t>> readers_;
  Schedule schedule_;
};

}  // namespace

Schedule schedule(const Graph& graph, bool guards) {
  if (guards) return Scheduler(graph).run();
  Schedule plain;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (graph.uses[i] > 0 && graph.nodes[i].is_lane()) plain.order.emplace_back(i);
  return plain;
}

}  // namespace tyndall::vm
