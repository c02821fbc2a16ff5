// Moving things into world space.
#pragma once

#include <optional>
#include <string>

#include "base/transform.h"
#include "optics/lights.h"

namespace tyndall::resolve {

// The factor by which all lengths grow when the map is a rotation, mirroring and uniform scale (to 1e-6 of
// it); nothing for others.
std::optional<double> similarity_scale(const Transform& t);

// Moves a light from its statement's space to the world's. Power, intensity and irradiance hold whatever the
// map; radiance is per world area. False when the light's shape does not survive the map (a sphere
// stretched).
bool to_world(optics::PointLight& light, const Transform& world_from_local);
bool to_world(optics::SpotLight& light, const Transform& world_from_local);
bool to_world(optics::SphereLight& light, const Transform& world_from_local);
bool to_world(optics::QuadLight& light, const Transform& world_from_local);
bool to_world(optics::DiskLight& light, const Transform& world_from_local);
bool to_world(optics::MeshLight& light, const Transform& world_from_local);
bool to_world(optics::DistantLight& light, const Transform& world_from_local);
bool to_world(optics::EnvironmentLight& light, const Transform& world_from_local);

}  // namespace tyndall::resolve
