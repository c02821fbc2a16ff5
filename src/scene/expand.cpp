// Instances written out: the things of a prototype where it was placed.
#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// Calls place(instance, world_from_object, material, visible) for each instance in a list and within its
// prototypes.
template <class Place>
void for_each_placed(const Scene& scene, const std::vector<Instance>& instances,
                     const Transform& world_from_outer, MaterialId outer_material, bool outer_visible,
                     const Place& place) {
  for (const Instance& instance : instances) {
    const Transform world_from_object = world_from_outer * instance.world_from_object;
    const MaterialId material = instance.material.valid() ? instance.material : outer_material;
    const bool visible = outer_visible && instance.visible;
    const Prototype& prototype = scene.prototypes[instance.prototype.index];
    place(prototype, world_from_object, material, visible);
    for_each_placed(scene, prototype.instances, world_from_object, material, visible, place);
  }
}

Volume placed(const Volume& volume, const Transform& world_from_object, bool visible) {
  Volume out = volume;
  out.world_from_shape = world_from_object * volume.world_from_shape;
  out.world_from_medium = world_from_object * volume.world_from_medium;
  out.visible = volume.visible && visible;
  return out;
}

}  // namespace

std::vector<Volume> all_volumes(const Scene& scene) {
  std::vector<Volume> volumes = scene.volumes;
  for_each_placed(
      scene, scene.instances, {}, {}, true,
      [&](const Prototype& prototype, const Transform& world_from_object, MaterialId, bool visible) {
        for (const Volume& volume : prototype.volumes)
          volumes.push_back(placed(volume, world_from_object, visible));
      });
  return volumes;
}

Scene expanded(const Scene& scene) {
  Scene out = scene;
  out.volumes = all_volumes(scene);
  for_each_placed(
      scene, scene.instances, {}, {}, true,
      [&](const Prototype& prototype, const Transform& world_from_object, MaterialId material, bool visible) {
        for (ShapeInstance shape : prototype.shapes) {
          shape.world_from_object = world_from_object * shape.world_from_object;
          if (!shape.material.valid()) shape.material = material;
          shape.visible = shape.visible && visible;
          out.shapes.push_back(std::move(shape));
        }
      });
  out.prototypes.clear();
  out.instances.clear();
  return out;
}

}  // namespace tyndall::scene
