// From the graph of values to code: what is needed, where it runs, and which row holds it.
#include <algorithm>
#include <bit>
#include <functional>
#include <queue>

#include "base/check.h"
#include "vm/builder.h"

namespace tyndall::vm {

// The part of the graph that some outputs need, and the program written from it.
class Builder::Writer {
 public:
  Writer(const Builder& builder, std::span<const NodeId> outputs)
      : nodes_(builder.nodes_), uses_(nodes_.size(), 0), outputs_(outputs) {
    mark();
    if (builder.fold_) fuse();
  }

  std::optional<Program> write() {
    number_values();
    const std::size_t fixed = program_.constants.size() + program_.inputs.size() + uniforms_;
    if (fixed > limit) return std::nullopt;
    program_.uniform_count = static_cast<std::uint16_t>(uniforms_);
    find_last_readers();
    write_code();
    if (fixed + rows_ > limit) return std::nullopt;
    program_.row_count = static_cast<std::uint16_t>(rows_);
    for (const NodeId output : outputs_) program_.outputs.push_back(operand(output));
    CHECK_EQ(verify(program_), std::string());
    return std::move(program_);
  }

 private:
  static constexpr std::size_t limit = 65535;

  std::size_t index_of(const Node& node) const { return static_cast<std::size_t>(&node - nodes_.data()); }
  static bool is_operation(const Node& node) { return node.kind == Node::Kind::operation; }
  static bool is_lane(const Node& node) { return is_operation(node) && !node.uniform; }
  std::span<const NodeId> operands(const Node& node) const {
    return std::span(node.operands)
        .first(is_operation(node) ? static_cast<std::size_t>(op_info(node.op).operands) : 0);
  }

  // Counts the readers of every value that the outputs need; the others keep none.
  void mark() {
    for (const NodeId output : outputs_) ++uses_[output.index];
    for (std::size_t i = nodes_.size(); i-- > 0;)
      if (uses_[i] > 0)
        for (const NodeId id : operands(nodes_[i])) ++uses_[id.index];
  }

  // a*b + c with no other reader of the product is one instruction; it rounds twice, so nothing changes.
  void fuse() {
    for (Node& node : nodes_) {
      if (uses_[index_of(node)] == 0 || !is_operation(node) || node.op != Op::add) continue;
      for (const std::size_t k : {0u, 1u}) {
        const NodeId product = node.operands[k];
        const Node& factor = nodes_[product.index];
        const bool fits = is_operation(factor) && factor.op == Op::mul && uses_[product.index] == 1 &&
                          factor.uniform == node.uniform;
        if (!fits) continue;
        node.operands = {factor.operands[0], factor.operands[1], node.operands[1 - k], NodeId{}};
        node.op = Op::fma;
        uses_[product.index] = 0;
        break;
      }
    }
  }

  // Constants, inputs and uniforms in the order in which they are first needed.
  void number_values() {
    place_.assign(nodes_.size(), 0);
    const auto number = [&](NodeId id) {
      const Node& node = nodes_[id.index];
      if (numbered_[id.index]) return;
      if (node.kind == Node::Kind::constant) {
        place_[id.index] = program_.constants.size();
        program_.constants.push_back(node.value);
      } else if (node.kind == Node::Kind::input) {
        place_[id.index] = program_.inputs.size();
        program_.inputs.push_back(node.input);
      }
      numbered_[id.index] = true;
    };
    numbered_.assign(nodes_.size(), false);
    for (const Node& node : nodes_) {
      if (uses_[index_of(node)] == 0) continue;
      for (const NodeId id : operands(node)) number(id);
      if (is_operation(node) && node.uniform) place_[index_of(node)] = uniforms_++;
    }
    for (const NodeId output : outputs_) number(output);
  }

  void find_last_readers() {
    last_reader_.assign(nodes_.size(), 0);
    for (const Node& node : nodes_)
      if (uses_[index_of(node)] > 0)
        for (const NodeId id : operands(node)) last_reader_[id.index] = index_of(node);
    for (const NodeId output : outputs_) last_reader_[output.index] = nodes_.size();
  }

  void write_code() {
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free_rows;
    for (const Node& node : nodes_) {
      const std::size_t i = index_of(node);
      if (uses_[i] == 0 || !is_operation(node)) continue;
      Instruction instruction;
      instruction.op = node.op;
      instruction.count = node.count;
      instruction.immediate = node.immediate;
      const auto reads = operands(node);
      for (std::size_t k = 0; k < reads.size(); ++k) instruction.operands[k] = operand(reads[k]);
      if (is_lane(node)) {
        for (std::size_t k = 0; k < reads.size(); ++k) {
          const NodeId id = reads[k];
          const bool again = std::find(reads.begin(), reads.begin() + static_cast<std::ptrdiff_t>(k), id) !=
                             reads.begin() + static_cast<std::ptrdiff_t>(k);
          if (!again && is_lane(nodes_[id.index]) && last_reader_[id.index] == i)
            free_rows.push(place_[id.index]);
        }
        if (free_rows.empty()) {
          place_[i] = rows_++;
        } else {
          place_[i] = free_rows.top();
          free_rows.pop();
        }
      }
      instruction.destination = operand(NodeId(i));
      (node.uniform ? program_.uniform_code : program_.lane_code).push_back(instruction);
      (node.uniform ? program_.uniform_spans : program_.lane_spans).push_back(node.span);
    }
  }

  Operand operand(NodeId id) const {
    const Node& node = nodes_[id.index];
    const std::size_t first = node.kind == Node::Kind::constant ? 0
                              : node.kind == Node::Kind::input  ? program_.first_input()
                              : node.uniform                    ? program_.first_uniform()
                                                                : program_.first_row();
    return static_cast<Operand>(first + place_[id.index]);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> uses_;  // readers, outputs among them
  std::span<const NodeId> outputs_;
  std::vector<std::size_t> place_, last_reader_;
  std::vector<bool> numbered_;
  std::size_t uniforms_ = 0, rows_ = 0;
  Program program_;
};

std::optional<Program> Builder::finish(std::span<const NodeId> outputs) const {
  for (const NodeId output : outputs) CHECK_LT(output.index, nodes_.size());
  return Writer(*this, outputs).write();
}

}  // namespace tyndall::vm
