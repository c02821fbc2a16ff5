// From the optimised graph to code: where each value stands, and which row holds it how long.
#include <algorithm>
#include <functional>
#include <queue>

#include "base/check.h"
#include "vm/builder/builder.h"

namespace tyndall::vm {

namespace {

constexpr std::size_t limit = 65535;

// The program written from a graph.
class Writer {
 public:
  Writer(const Graph& graph, const Tables& tables, Schedule schedule)
      : graph_(graph), tables_(tables), schedule_(std::move(schedule)) {}

  std::optional<Program> write() {
    number_values();
    const std::size_t fixed = program_.constants.size() + program_.inputs.size() + uniforms_;
    if (fixed > limit) return std::nullopt;
    program_.uniform_count = static_cast<std::uint16_t>(uniforms_);
    find_last_readers();
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
      if (graph_.uses[i] > 0 && graph_.nodes[i].is_operation() && graph_.nodes[i].uniform)
        write(NodeId(i), program_.uniform_code, program_.uniform_spans);
    for (std::size_t place = 0; place < schedule_.order.size(); ++place) write_lane(place);
    if (fixed + rows_ > limit) return std::nullopt;
    program_.row_count = static_cast<std::uint16_t>(rows_);
    for (const NodeId output : graph_.outputs) program_.outputs.push_back(operand(output));
    CHECK_EQ(verify(program_), std::string());
    program_.fingerprint = fingerprint_of(program_);
    return std::move(program_);
  }

 private:
  // Constants, inputs and uniforms in the order in which they are first needed.
  void number_values() {
    place_.assign(graph_.nodes.size(), 0);
    std::vector<bool> numbered(graph_.nodes.size(), false);
    const auto number = [&](NodeId id) {
      const Node& node = graph_[id];
      if (numbered[id.index]) return;
      if (node.kind == Node::Kind::constant) {
        place_[id.index] = program_.constants.size();
        program_.constants.push_back(node.value);
      } else if (node.kind == Node::Kind::input) {
        place_[id.index] = program_.inputs.size();
        program_.inputs.push_back(node.input);
      }
      numbered[id.index] = true;
    };
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      const Node& node = graph_.nodes[i];
      if (graph_.uses[i] == 0) continue;
      for (const NodeId id : node.reads()) number(id);
      if (node.is_operation() && node.uniform) place_[i] = uniforms_++;
    }
    for (const NodeId output : graph_.outputs) number(output);
  }

  // The place in the order after which a value is needed no more. A guard reads its condition before the
  // select that made it does, so it counts for nothing here.
  void find_last_readers() {
    last_reader_.assign(graph_.nodes.size(), 0);
    for (std::size_t place = 0; place < schedule_.order.size(); ++place)
      for (const NodeId id : graph_[schedule_.order[place]].reads()) last_reader_[id.index] = place;
    for (const NodeId output : graph_.outputs) last_reader_[output.index] = schedule_.order.size();
  }

  void write_lane(std::size_t place) {
    while (next_guard_ < schedule_.guards.size() && schedule_.guards[next_guard_].first == place) {
      const Schedule::Guard& guard = schedule_.guards[next_guard_++];
      program_.guards.push_back({guard.first, guard.last, operand(guard.condition), guard.when});
    }
    const NodeId id = schedule_.order[place];
    const auto reads = graph_[id].reads();
    Instruction instruction = instruction_of(id);
    for (std::size_t k = 0; k < reads.size(); ++k) {
      const bool again = std::find(reads.begin(), reads.begin() + static_cast<std::ptrdiff_t>(k), reads[k]) !=
                         reads.begin() + static_cast<std::ptrdiff_t>(k);
      if (!again && graph_[reads[k]].is_lane() && last_reader_[reads[k].index] == place)
        free_rows_.push(place_[reads[k].index]);
    }
    // An instruction may write where it reads: every vector is read before it is written.
    if (free_rows_.empty()) {
      place_[id.index] = rows_++;
    } else {
      place_[id.index] = free_rows_.top();
      free_rows_.pop();
    }
    instruction.destination = operand(id);
    program_.lane_code.push_back(instruction);
    program_.lane_spans.push_back(graph_[id].span);
  }

  void write(NodeId id, std::vector<Instruction>& code, std::vector<Span>& spans) {
    Instruction instruction = instruction_of(id);
    instruction.destination = operand(id);
    code.push_back(instruction);
    spans.push_back(graph_[id].span);
  }

  Instruction instruction_of(NodeId id) {
    const Node& node = graph_[id];
    Instruction instruction;
    instruction.op = node.op;
    instruction.count = node.count;
    instruction.immediate = immediate_of(node);
    const auto reads = node.reads();
    for (std::size_t k = 0; k < reads.size(); ++k) instruction.operands[k] = operand(reads[k]);
    return instruction;
  }

  // The program holds what it looks up in, in the order in which it is first read.
  std::uint32_t immediate_of(const Node& node) {
    if (op_info(node.op).has(OpTrait::plane))
      return index_in(program_.tables.planes, tables_.planes[node.immediate]);
    if (op_info(node.op).has(OpTrait::voxels))
      return index_in(program_.tables.voxels, tables_.voxels[node.immediate]);
    return node.immediate;
  }

  Operand operand(NodeId id) const {
    const Node& node = graph_[id];
    const std::size_t first = node.kind == Node::Kind::constant ? 0
                              : node.kind == Node::Kind::input  ? program_.first_input()
                              : node.uniform                    ? program_.first_uniform()
                                                                : program_.first_row();
    return static_cast<Operand>(first + place_[id.index]);
  }

  const Graph& graph_;
  const Tables& tables_;
  const Schedule schedule_;
  std::vector<std::size_t> place_, last_reader_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free_rows_;
  std::size_t uniforms_ = 0, rows_ = 0, next_guard_ = 0;
  Program program_;
};

}  // namespace

std::optional<Program> Builder::finish(std::span<const NodeId> outputs) const {
  for (const NodeId output : outputs) CHECK_LT(output.index, nodes_.size());
  Graph graph(nodes_, outputs);
  if (fold_) fuse(graph);
  return Writer(graph, tables_, schedule(graph, guards_)).write();
}

}  // namespace tyndall::vm
