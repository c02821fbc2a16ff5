#include "shader/limits.h"

#include <algorithm>

namespace tyndall::shader {

using eval::Scalar;

Scalar Limits::limit(const Scalar& given, const NumberRange& range) {
  return evaluator_.emit(vm::Op::limit, {given, Scalar{range.lowest}, Scalar{range.highest}}, range.span);
}

Scalar Limits::limited(const Scalar& given, const NumberRange& range) {
  if (given.known()) return given;
  if (!range.branches.constant) shown_.push_back({given, range});
  return limit(given, range);
}

Scalar Limits::limited(const Scalar& given, const NumberRange& range, const Scalar& weight) {
  if (given.known()) return given;
  show(given, range, weight);
  return limit(given, range);
}

// Where it does not count, a number in the range stands for it.
void Limits::show(const Scalar& given, const NumberRange& range, const Scalar& weight) {
  if (given.known()) return;
  shown_.push_back({weight.known()
                        ? given
                        : evaluator_.emit(vm::Op::select, {weight, given, Scalar{range.lowest}}, range.span),
                    range});
}

std::vector<scene::GivenNumber> Limits::given(OutputList& full, OutputList& extinction) const {
  std::vector<scene::GivenNumber> out;
  for (const auto& [value, range] : shown_) {
    scene::GivenNumber number{range.name, range.span, range.lowest, range.highest};
    number.output = full.index(value, range.span);
    number.scales = range.scales;
    const bool again = std::any_of(out.begin(), out.end(), [&](const scene::GivenNumber& other) {
      return other.output == number.output && other.span == number.span && other.name == number.name;
    });
    if (again) continue;
    if (range.in_extinction) number.extinction_output = extinction.index(value, range.span);
    if (range.branches.places.size() > 1) {
      number.branches = range.branches.places;
      number.branch_output = full.index(range.branches.taken, range.span);
      if (range.in_extinction)
        number.extinction_branch_output = extinction.index(range.branches.taken, range.span);
    }
    out.push_back(std::move(number));
  }
  return out;
}

}  // namespace tyndall::shader
