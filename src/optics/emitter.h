// Surfaces that shine, drawn evenly over their area: what mesh lights and shapes of glowing material are.
#pragma once

#include <variant>
#include <vector>

#include "base/transform.h"
#include "base/vec.h"
#include "shapes/shape.h"

namespace tyndall::optics {

// What an emitter is made of: flat faces, or a shape that is drawn over its curved area (shapes::Sampled), in
// its own space.
struct EmitterTriangles {
  std::vector<shapes::Triangle> corners;
  std::vector<double> sums{};  // running areas: one more than triangles, from 0; filled by Emitter
};
using EmitterSurface = std::variant<EmitterTriangles, shapes::Shape>;

class Emitter {
 public:
  // Triangles are moved to the world at once; the others are drawn in their own space, so that a stretched
  // sphere is drawn from with a density that varies over it.
  Emitter(EmitterSurface surface, const Transform& world_from_object);

  // In the world.
  shapes::SurfacePoint sample(float u0, float u1) const;
  // Density per world area [1/m²] of drawing a point where the surface has this unit normal.
  double pdf_area(const Vec3d& normal) const;

  // In the world [m²]; of curved surfaces exact for maps that keep shapes, a mean otherwise.
  double area() const { return area_; }
  const Vec3d& center() const { return center_; }  // of its box
  double radius() const { return radius_; }        // of a sphere around that which holds it

 private:
  EmitterSurface surface_;
  Transform world_from_object_;
  double object_area_ = 0, area_ = 0, determinant_ = 1, radius_ = 0;
  Vec3d center_;
};

}  // namespace tyndall::optics
