// Directions along the surface, for normal maps.
#pragma once

#include "scene/scene.h"

namespace tyndall::pbr {

// Normals of no length, which exporters leave at points of slivers, become those of the triangles there.
void mend_normals(scene::TriangleMesh& mesh);

// Gives each point the direction in which u grows, of the triangles around it weighted with their angles
// there (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), and the sign of its bitangent. Points
// where mirrored parts of a texture meet become two. Does nothing without uvs.
void add_tangents(scene::TriangleMesh& mesh);

}  // namespace tyndall::pbr
