// Densities for tests, written as C++ expressions: p.x * p.x + 0.5f. They become bytecode without the
// language.
#pragma once

#include "vm/builder/builder.h"

namespace tyndall::support {

// One value of a program under construction.
struct Expression {
  vm::Builder* builder = nullptr;
  vm::NodeId node;

  Expression like(float value) const { return {builder, builder->constant(value)}; }
  Expression apply(vm::Op op) const { return {builder, builder->emit(op, {node}, {})}; }
  Expression apply(vm::Op op, const Expression& b) const {
    return {builder, builder->emit(op, {node, b.node}, {})};
  }
};

inline Expression operator+(const Expression& a, const Expression& b) { return a.apply(vm::Op::add, b); }
inline Expression operator-(const Expression& a, const Expression& b) { return a.apply(vm::Op::sub, b); }
inline Expression operator*(const Expression& a, const Expression& b) { return a.apply(vm::Op::mul, b); }
inline Expression operator+(const Expression& a, float b) { return a + a.like(b); }
inline Expression operator-(const Expression& a, float b) { return a - a.like(b); }
inline Expression operator*(const Expression& a, float b) { return a * a.like(b); }
inline Expression operator-(float a, const Expression& b) { return b.like(a) - b; }
inline Expression exp(const Expression& a) { return a.apply(vm::Op::exp); }
inline Expression cos(const Expression& a) { return a.apply(vm::Op::cos); }
inline Expression abs(const Expression& a) { return a.apply(vm::Op::abs); }
inline Expression floor(const Expression& a) { return a.apply(vm::Op::floor); }
inline Expression fract(const Expression& a) { return a.apply(vm::Op::fract); }
inline Expression max(const Expression& a, float b) { return a.apply(vm::Op::max, a.like(b)); }
inline Expression less(const Expression& a, float b) { return a.apply(vm::Op::less, a.like(b)); }

// The position just inside the volume's transform.
struct Point {
  Expression x, y, z;
};
inline Point point_input(vm::Builder& builder) {
  return {{&builder, builder.input(vm::Input::p_x)},
          {&builder, builder.input(vm::Input::p_y)},
          {&builder, builder.input(vm::Input::p_z)}};
}
inline Expression length(const Point& p) {
  return {p.x.builder, p.x.builder->emit(vm::Op::length3, {p.x.node, p.y.node, p.z.node}, {})};
}

}  // namespace tyndall::support
