// Numbers of a body that may leave their range while its program runs (internal to this layer).
#pragma once

#include <string>
#include <vector>

#include "eval/evaluator.h"
#include "scene/medium.h"
#include "shader/outputs.h"

namespace tyndall::shader {

// Where a number belongs, and what it is called.
struct NumberRange {
  std::string name;
  Span span;  // the statement
  double lowest = 0, highest = 0;
  bool scales = false;         // a coefficient, or one's factor
  bool in_extinction = false;  // one of extinction
  eval::Evaluator::Branches branches{};
};

// Limits numbers, and remembers them as the body gave them. Known ones are in their range: the others were
// refused.
class Limits {
 public:
  explicit Limits(eval::Evaluator& evaluator) : evaluator_(evaluator) {}

  eval::Scalar limited(const eval::Scalar& given, const NumberRange& range);
  // The same of a number that counts only where `weight` is not 0.
  eval::Scalar limited(const eval::Scalar& given, const NumberRange& range, const eval::Scalar& weight);
  // Shows a number whose limits are kept already.
  void show(const eval::Scalar& given, const NumberRange& range, const eval::Scalar& weight);

  // Adds what was shown to the lists of outputs.
  std::vector<scene::GivenNumber> given(OutputList& full, OutputList& extinction) const;

 private:
  struct Shown {
    eval::Scalar value;
    NumberRange range;
  };
  eval::Scalar limit(const eval::Scalar& given, const NumberRange& range);

  eval::Evaluator& evaluator_;
  std::vector<Shown> shown_;
};

}  // namespace tyndall::shader
