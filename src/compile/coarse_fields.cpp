#include "compile/coarse_fields.h"

#include <algorithm>
#include <cmath>

#include "compile/geometry/geometry.h"
#include "vm/run/machine.h"

namespace tyndall::compile {

namespace {

// Looks along each axis of a box, its ends included.
constexpr std::size_t looks = 5, points = looks * looks * looks;

class Finder {
 public:
  explicit Finder(const CompiledScene& world) : world_(world) {}

  // Looks over a box of p, which stands so in the world.
  void look(const scene::LatticePlaces& places, const std::string& shader, const Bounds& box,
            const Transform& world_from_p) {
    if (places.fields.empty()) return;
    std::array<std::array<float, points>, vm::input_count> inputs{};
    vm::BatchInputs lanes;
    for (std::size_t i = 0; i < points; ++i) {
      const Vec3d share = Vec3d{static_cast<double>(i % looks), static_cast<double>(i / looks % looks),
                                static_cast<double>(i / (looks * looks))} *
                          (1.0 / (looks - 1));
      const Vec3d p = box.lo + (box.hi - box.lo) * share, P = world_from_p.point(p);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        inputs[static_cast<std::size_t>(vm::Input::p_x) + axis][i] = static_cast<float>(p[axis]);
        inputs[static_cast<std::size_t>(vm::Input::P_x) + axis][i] = static_cast<float>(P[axis]);
      }
    }
    for (std::size_t i = 0; i < vm::input_count; ++i) lanes.lanes[i] = inputs[i].data();
    const float time = world_.seconds_at(0);
    lanes[vm::Input::time] = &time;
    std::vector<float> values(places.program.outputs.size() * points);
    std::vector<float*> outputs;
    for (std::size_t k = 0; k < places.program.outputs.size(); ++k) outputs.push_back(&values[k * points]);
    machine_.run(places.program, lanes, points, outputs);
    for (const scene::LatticePlaces::Field& field : places.fields) {
      float reach = 0;
      for (std::size_t i = field.first * points; i < (field.first + field.count) * points; ++i)
        reach = std::max(reach, std::abs(values[i]));
      if (reach > coarse_place) note({shader, field.name, field.span, reach});
    }
  }
  std::vector<CoarseField> found;

 private:
  void note(const CoarseField& coarse) {
    for (CoarseField& other : found)
      if (other.span == coarse.span) {
        other.reach = std::max(other.reach, coarse.reach);
        return;
      }
    found.push_back(coarse);
  }

  const CompiledScene& world_;
  vm::Machine machine_;
};

// The box around what a transform makes of another.
Bounds box_around(const Bounds& box, const Transform& t) {
  const Vec3d middle = t.point((box.lo + box.hi) * 0.5), half = (box.hi - box.lo) * 0.5;
  Vec3d reach;
  for (std::size_t axis = 0; axis < 3; ++axis)
    reach[axis] = std::abs(t.x[axis]) * half.x + std::abs(t.y[axis]) * half.y + std::abs(t.z[axis]) * half.z;
  return {middle - reach, middle + reach};
}

}  // namespace

std::vector<CoarseField> find_coarse_fields(const CompiledScene& world) {
  Finder finder(world);
  for (const CompiledVolume& volume : world.volumes) {
    const CompiledMedium& medium = world.media[volume.medium];
    const auto bounds = world.geometry->bounds_of(volume.shape);
    const auto render_from_medium = volume.medium_from_render.inverse();
    if (medium.lattice_places.fields.empty() || !bounds || !render_from_medium) continue;
    finder.look(medium.lattice_places, medium.name,
                box_around(*bounds, volume.medium_from_render * volume.render_from_shape),
                Transform::translate(world.origin) * *render_from_medium);
  }
  for (const scene::ShapeInstance& shape : world.scene.shapes) {
    const scene::Material& material = world.scene.materials[shape.material.index];
    if (material.lattice_places.fields.empty()) continue;
    if (const auto bounds = world.geometry->bounds_of(shape.shape))
      finder.look(material.lattice_places, material.name, *bounds, shape.world_from_object);
  }
  return std::move(finder.found);
}

}  // namespace tyndall::compile
