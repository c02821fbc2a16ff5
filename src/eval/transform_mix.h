// The way from one transform to another.
#pragma once

#include "base/transform.h"

namespace tyndall::eval {

// a at t = 0, b at t = 1. Rotations turn the short way at a steady rate (slerp), stretches and offsets move
// in a straight line: the polar decomposition of Shoemake and Duff, "Matrix animation and polar
// decomposition" (1992). Where one of them flattens or mirrors what the other does not, every number moves in
// a straight line.
Transform mix(const Transform& a, const Transform& b, double t);

}  // namespace tyndall::eval
