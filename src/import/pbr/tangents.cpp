#include "import/pbr/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall::pbr {

namespace {

Vec3d area_normal(const scene::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

// The angle of a triangle at its corner k.
double angle_at(const scene::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t, std::size_t k) {
  const Vec3d a = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]],
              b = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// A point with its own corners: triangles whose texture is mirrored take a copy of it.
struct Split {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<std::uint32_t> copies;
  std::vector<signed char> signs;  // of the points' first triangles; 0: none yet

  explicit Split(std::size_t points) : copies(points, none), signs(points, 0) {}

  std::uint32_t point(scene::TriangleMesh& mesh, std::uint32_t i, signed char sign) {
    if (signs[i] == 0) signs[i] = sign;
    if (signs[i] == sign) return i;
    if (copies[i] == none) {
      copies[i] = static_cast<std::uint32_t>(mesh.points.size());
      const auto repeat = [&](auto& list) {
        if (!list.empty()) list.push_back(std::remove_reference_t<decltype(list[i])>(list[i]));
      };
      repeat(mesh.points);
      repeat(mesh.normals);
      repeat(mesh.uvs);
      repeat(mesh.second_uvs);
      repeat(mesh.colors);
    }
    return copies[i];
  }
};

}  // namespace

void mend_normals(scene::TriangleMesh& mesh) {
  if (mesh.normals.empty()) return;
  std::vector<bool> bad(mesh.normals.size(), false);
  bool any = false;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const double size = length(mesh.normals[i]);
    bad[i] = !(size > 0) || !std::isfinite(size);
    if (bad[i]) mesh.normals[i] = {};
    any |= bad[i];
  }
  if (!any) return;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      if (bad[corner]) mesh.normals[corner] += area_normal(mesh, triangle);
  for (std::size_t i = 0; i < bad.size(); ++i)
    if (!(length_squared(mesh.normals[i]) > 0)) mesh.normals[i] = {0, 0, 1};
}

void add_tangents(scene::TriangleMesh& mesh) {
  if (mesh.uvs.empty()) return;
  Split split(mesh.points.size());
  std::vector<Vec3d> along_u(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    auto& t = mesh.triangles[i];
    const Pair<double>&a = mesh.uvs[t[0]], &b = mesh.uvs[t[1]], &c = mesh.uvs[t[2]];
    const double bu = b.x - a.x, bv = b.y - a.y, cu = c.x - a.x, cv = c.y - a.y;
    const double area = bu * cv - bv * cu;
    const Vec3d e1 = mesh.points[t[1]] - mesh.points[t[0]], e2 = mesh.points[t[2]] - mesh.points[t[0]];
    const Vec3d u = (e1 * cv - e2 * bv) * (area < 0 ? -1.0 : 1.0);
    along_u[i] = length_squared(u) > 0 ? normalize(u) : Vec3d{};
    if (area == 0) continue;
    const signed char sign = area < 0 ? -1 : 1;
    for (std::uint32_t& corner : t) corner = split.point(mesh, corner, sign);
  }
  std::vector<Vec3d> sums(mesh.points.size());
  std::vector<float> signs(mesh.points.size(), 1.0f);
  for (std::size_t i = 0; i < split.signs.size(); ++i) {
    if (split.signs[i] != 0) signs[i] = split.signs[i];
    if (split.copies[i] != Split::none) signs[split.copies[i]] = -signs[i];
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sums[mesh.triangles[i][k]] += along_u[i] * angle_at(mesh, mesh.triangles[i], k);
  mesh.tangents.resize(mesh.points.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Vec3d t = length_squared(sums[i]) > 0 ? normalize(sums[i]) : Vec3d{};
    mesh.tangents[i] = {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z), signs[i]};
  }
}

}  // namespace tyndall::pbr
