// How far a hit may lie off its surface, and so how far off it the rays that leave it must start. All that is
// known about this is here; each shape (ShapeHit::reach) and each transform adds its part.
//
// Every shape brings its hits onto its surface by its own equation, so what is left of the ray's length and
// of where it came from lies along the surface, where it does no harm. Across the surface there is left, in
// the shape's own space and with u = 2^-53:
//
// - rounding of the place itself, up to 3u of what it is the sum of: centre and radius, corners, half edges;
// - what the next ray's crossing of the same shape makes of its start o. A sphere asks for |o - c|² - r²,
//   whose terms are each good to 4u r²: 8u r across. A box asks for min - o, whose sign is exact; plane and
//   disk for n · (c - o), good to 4u in each axis. So does a quad, but its n is a product of its half edges:
//   turned by 2u, and by more the more they are parallel. A triangle is seen along the ray, which mixes
//   the axes: 8u of its longest side. So does a cylinder, whose crossings are found in a frame about its
//   axis: 8u of its height and radius; and so do cones. A torus is asked for the distance to its tube, good
//   to 8u of its radius and tube. Shapes combined are asked for one of their parts.
//
// `reach` is the sum of these lengths, by axis, and `rounding` times it more than the error (Higham,
// "Accuracy and Stability of Numerical Algorithms", 2002, ch. 3; Pharr, Jakob and Humphreys, "Physically
// Based Rendering", 2023, §6.8). An affine map adds the rounding of its own sums, on the way to the hit and
// on the way back into the shape's space, and what its inverse is off, which is not bounded but measured.
#pragma once

#include "base/transform.h"
#include "base/vec.h"
#include "shapes/placed_error.h"
#include "shapes/query.h"

namespace tyndall::compile {

using shapes::placed_error;
using shapes::rounding;

Vec3d triangle_reach(const Vec3d& a, const Vec3d& b, const Vec3d& c);

// How far along its unit normal a ray that leaves a place of render space must start. `origin` is the world
// position of render space's zero: transforms are given in the world.
double offset_along(const Vec3d& normal, const Vec3d& position, const Vec3d& origin, const Vec3d& error);

// The largest error of any hit with what stands within a ball of render space.
double largest_error(const Transform& render_from_object, const Vec3d& center, double radius,
                     const Vec3d& origin);

// a b - c d to 2u of itself, however much of it cancels (Kahan; Jeannerod, Louvet and Muller, Mathematics of
// Computation 82, 2013).
double difference_of_products(double a, double b, double c, double d);

}  // namespace tyndall::compile
