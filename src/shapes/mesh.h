#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/fields.h"
#include "base/id.h"
#include "base/vec.h"

namespace tyndall::shapes {

// Where the points of a mesh are at a moment, and what turns with them.
struct MeshPose {
  std::vector<Vec3d> points;
  std::vector<Vec3d> normals{};                  // one a point, or none
  std::vector<std::array<float, 4>> tangents{};  // likewise
  bool operator==(const MeshPose&) const = default;
};

// Triangles between points; front sides are those from which the corners run counter-clockwise.
struct TriangleMesh {
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of points
  std::vector<Vec3d> normals{};                         // one a point, or none
  std::vector<Pair<double>> uvs{};                      // one a point, or none
  // What materials of imported files read besides (vm::Input), one a point, or none: the way in which u grows
  // along the surface with the sign of the bitangent, red green blue and opacity, other uvs.
  std::vector<std::array<float, 4>> tangents{}, colors{};
  std::vector<Pair<double>> second_uvs{};
  bool thin = false;  // has no inside, though it may be closed: glass is a pane
  // Of a mesh that deforms: its poses after that of when the shutter opens, evenly apart until it closes.
  // Between two poses everything is interpolated linearly.
  std::vector<MeshPose> later{};
  bool operator==(const TriangleMesh&) const = default;

  std::size_t bytes() const {
    const auto of = [](const auto& list) { return list.size() * sizeof(list[0]); };
    std::size_t sum =
        of(points) + of(triangles) + of(normals) + of(uvs) + of(tangents) + of(colors) + of(second_uvs);
    for (const MeshPose& pose : later) sum += of(pose.points) + of(pose.normals) + of(pose.tangents);
    return sum;
  }
};
using MeshId = Id<TriangleMesh>;

// A mesh that scenes have in common, as those of the frames of a sequence have what does not change. Nobody
// changes it; another one takes its place.
class SharedMesh {
 public:
  SharedMesh(TriangleMesh mesh) : shared_(std::make_shared<Shared>(std::move(mesh))) {}

  const TriangleMesh& operator*() const { return shared_->mesh; }
  const TriangleMesh* operator->() const { return &shared_->mesh; }
  // Whether it is the very same, not one like it.
  bool operator==(const SharedMesh&) const = default;

  // What takes a while to find out, once it is known. For one thread at a time.
  struct Findings {
    std::optional<std::size_t> open_edges{};  // scene::open_edges
    std::string print_hash{};                 // of its printed form; empty: not known yet
  };
  Findings& findings() const { return shared_->findings; }

 private:
  struct Shared {
    explicit Shared(TriangleMesh m) : mesh(std::move(m)) {}
    const TriangleMesh mesh;
    Findings findings{};
  };
  std::shared_ptr<Shared> shared_;
};

// One of the scene's meshes, as a shape.
struct Mesh {
  static constexpr std::string_view keyword = "mesh";
  static constexpr std::string_view documentation =
      "It has an inside when every edge is between two triangles. `uv` is that of its points.";
  static constexpr bool closed = true;  // or so it should be: scene::open_edges
  MeshId mesh;
  template <class F>
  static void fields(F&& field) {
    field(&Mesh::mesh, FieldInfo{"mesh", "the number of the mesh"});
  }
};

}  // namespace tyndall::shapes
