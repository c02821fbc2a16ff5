// The outputs that a body may set, and reading them (internal to this layer).
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "eval/evaluator.h"
#include "scene/medium.h"

namespace tyndall::shader {

// What an output takes, and which known values are right.
struct OutputRule {
  std::string_view name;
  eval::Type type;     // vec: a colour unless `widens` is false
  bool widens = true;  // a number stands for a grey colour
  double lowest = 0;   // known values below or above are errors
  double highest = 0;
  std::string_view range;                              // as in messages: "in [0, 1]"
  std::string_view documentation = {}, standard = {};  // for the manual: what it is, its default
};

// What media and materials may set.
std::span<const OutputRule> medium_outputs();
std::span<const OutputRule> material_outputs();

// One output as the body set it.
struct Output {
  eval::Value value;
  Span span;  // of the assignment
  eval::Evaluator::Branches branches;
};

// Runs the body and gives the value of each rule's output, by index; nothing where it was not set. Reports
// unknown names, values out of range, and outputs set twice. `failed` turns true after any error.
std::vector<std::optional<Output>> run_body(eval::Evaluator& evaluator, const eval::Body& body,
                                            std::span<const OutputRule> rules, bool& failed);
// The same with the scope that the body is run in, so that its names can be looked at afterwards.
std::vector<std::optional<Output>> run_body(eval::Evaluator& evaluator, const eval::Body& body,
                                            const std::shared_ptr<eval::Scope>& scope,
                                            std::span<const OutputRule> rules, bool& failed);

// Where what `outputs` are made of asks for fields of a lattice.
scene::LatticePlaces lattice_places_of(const vm::Builder& builder, std::span<const vm::NodeId> outputs);

// Outputs of a program under construction: equal nodes share one, of the same statement or of any.
class OutputList {
 public:
  enum class Sharing : std::uint8_t { any, same_statement };
  explicit OutputList(eval::Evaluator& evaluator, Sharing sharing = Sharing::any)
      : evaluator_(evaluator), sharing_(sharing) {}

  // The index of the scalar's output, added when it is new; `span` is the statement it came from.
  std::uint8_t index(const eval::Scalar& scalar, Span span);
  std::array<std::uint8_t, 3> indices(const std::array<eval::Scalar, 3>& scalars, Span span);

  bool too_many() const { return nodes.size() > 256; }

  std::vector<vm::NodeId> nodes;
  std::vector<Span> spans;

 private:
  eval::Evaluator& evaluator_;
  Sharing sharing_;
};

}  // namespace tyndall::shader
