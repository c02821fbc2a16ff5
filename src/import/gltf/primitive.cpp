#include "import/gltf/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "import/gltf/accessor.h"
#include "import/gltf/attributes.h"
#include "import/pbr/tangents.h"

namespace tyndall::gltf {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

enum Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

// glTF 2.0, 3.7.2.1: the points of each triangle, in an order that keeps the front where it is.
Triangles triangles_of(const Element& primitive, std::uint64_t mode,
                       const std::vector<std::uint32_t>& corners) {
  Triangles out;
  const std::size_t n = corners.size();
  if (mode == triangles) {
    if (n % 3 != 0) primitive.fail(fmt::format("has {} corners, no multiple of 3", n));
    out.reserve(n / 3);
    for (std::size_t i = 0; i + 2 < n; i += 3) out.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return out;
  }
  for (std::size_t i = 0; i + 2 < n; ++i) {
    if (mode == triangle_fan)
      out.push_back({corners[i + 1], corners[i + 2], corners[0]});
    else
      out.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  return out;
}

std::vector<Vec3d> vecs(const std::vector<float>& floats) {
  std::vector<Vec3d> out(floats.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = Vec3d(Vec3f(floats[3 * i], floats[3 * i + 1], floats[3 * i + 2]));
  return out;
}

// v runs down in glTF and up here.
std::vector<Pair<double>> uvs(const std::vector<float>& floats) {
  std::vector<Pair<double>> out(floats.size() / 2);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {double{floats[2 * i]}, 1 - double{floats[2 * i + 1]}};
  return out;
}

std::vector<std::array<float, 4>> fours(const std::vector<float>& floats) {
  std::vector<std::array<float, 4>> out(floats.size() / 4);
  for (std::size_t i = 0; i < out.size(); ++i) std::copy_n(&floats[4 * i], 4, out[i].begin());
  return out;
}

std::vector<std::uint32_t> corners_of(const Element& primitive, Attributes& attributes) {
  auto stored = attributes.indices();
  if (!stored) {
    std::vector<std::uint32_t> all(attributes.points());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }
  for (std::size_t i = 0; i < stored->size(); ++i)
    if ((*stored)[i] >= attributes.points())
      primitive["indices"].fail(
          fmt::format("names point {} at {}, and there are {}", (*stored)[i], i, attributes.points()));
  return std::move(*stored);
}

// The corners of each line, two by two.
std::vector<std::uint32_t> lines_of(const Element& primitive, std::uint64_t mode,
                                    const std::vector<std::uint32_t>& corners) {
  if (mode == lines) {
    if (corners.size() % 2 != 0) primitive.fail(fmt::format("has {} ends of lines", corners.size()));
    return corners;
  }
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) out.insert(out.end(), {corners[i], corners[i + 1]});
  if (mode == line_loop && corners.size() > 2) out.insert(out.end(), {corners.back(), corners.front()});
  return out;
}

std::uint64_t mode_of(const Element& primitive) {
  const std::uint64_t mode = primitive.count("mode", triangles);
  if (mode > triangle_fan) primitive["mode"].fail(fmt::format("is {}: 0 to 6 are known", mode));
  return mode;
}

}  // namespace

Drawn drawn_by(const Element& primitive) {
  const std::uint64_t mode = mode_of(primitive);
  return mode == points ? Drawn::points : mode < triangles ? Drawn::lines : Drawn::triangles;
}

std::optional<Primitive> Primitive::read(Document& document, const Element& primitive,
                                         const PointNeeds& needs) {
  const std::uint64_t mode = mode_of(primitive);
  Attributes attributes(document, primitive);
  if (!attributes.has("POSITION") || attributes.points() == 0) return std::nullopt;
  Primitive out(document, primitive);
  out.needs_ = needs;
  scene::TriangleMesh& mesh = out.rest_;
  mesh.points = vecs(attributes.read("POSITION", 3));
  document.take(primitive, static_cast<double>(attributes.points()) * 64);
  const std::vector<std::uint32_t> corners = corners_of(primitive, attributes);
  document.take(primitive, static_cast<double>(corners.size()) * 12);
  if (drawn_by(primitive) == Drawn::triangles) {
    mesh.normals = vecs(attributes.read("NORMAL", 3));
    mesh.uvs = uvs(attributes.read("TEXCOORD_0", 2));
    if (needs.second_uvs > 0)
      mesh.second_uvs = uvs(attributes.read(fmt::format("TEXCOORD_{}", needs.second_uvs), 2));
    mesh.colors = fours(attributes.read_colors());
    if (needs.tangents) mesh.tangents = fours(attributes.read("TANGENT", 4));
    mesh.triangles = triangles_of(primitive, mode, corners);
    if (mesh.triangles.empty()) return std::nullopt;
  } else {
    out.corners_ = lines_of(primitive, mode, corners);
    if (out.corners_.empty()) return std::nullopt;
  }
  for (int set = 0; attributes.has(fmt::format("JOINTS_{}", set)); ++set) {
    const std::string name = fmt::format("JOINTS_{}", set);
    Influences& influences = out.influences_.emplace_back();
    influences.joints = attributes.read_joints(name);
    influences.weights = attributes.read(fmt::format("WEIGHTS_{}", set), 4);
    if (influences.weights.empty()) primitive["attributes"].fail(fmt::format("has {} without weights", name));
  }
  return out;
}

// What a morph target adds to each point at weight 1.
const std::vector<Vec3d>& Primitive::offsets(std::size_t target, const char* name, std::size_t count) {
  const auto [known, is_new] = offsets_.try_emplace({target, name});
  if (!is_new || count == 0) return known->second;
  const Element of = primitive_["targets"].at(target);
  if (const auto accessor = document_->index(of, name, "accessors")) {
    known->second = read_vecs(*document_, *accessor);
    if (known->second.size() != count)
      of[name].fail(fmt::format("is of {} points of {}", known->second.size(), count));
  }
  return known->second;
}

void Primitive::morph(const std::vector<double>& weights, scene::TriangleMesh& mesh) {
  const auto targets = primitive_.find("targets");
  if (!targets) return;
  for (std::size_t i = 0; i < std::min(targets->size(), weights.size()); ++i) {
    if (weights[i] == 0) continue;
    const auto add = [&](const char* name, std::size_t points, auto&& apply) {
      const std::vector<Vec3d>& list = offsets(i, name, points);
      for (std::size_t k = 0; k < std::min(list.size(), points); ++k) apply(k, list[k] * weights[i]);
    };
    add("POSITION", mesh.points.size(), [&](std::size_t k, const Vec3d& v) { mesh.points[k] += v; });
    add("NORMAL", mesh.normals.size(), [&](std::size_t k, const Vec3d& v) { mesh.normals[k] += v; });
    add("TANGENT", mesh.tangents.size(), [&](std::size_t k, const Vec3d& v) {
      for (std::size_t axis = 0; axis < 3; ++axis) mesh.tangents[k][axis] += static_cast<float>(v[axis]);
    });
  }
}

// Where the joints take each point, the influences weighted.
std::vector<Transform> Primitive::blends(const std::vector<Transform>& joints) const {
  std::vector<Transform> out(rest_.points.size(), Transform{{}, {}, {}, {}});
  std::vector<float> sums(out.size(), 0.0f);
  for (std::size_t set = 0; set < influences_.size(); ++set) {
    const auto& [indices, weights] = influences_[set];
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (weights[i] == 0) continue;
      if (indices[i] >= joints.size())
        primitive_["attributes"][fmt::format("JOINTS_{}", set)].fail(
            fmt::format("names joint {} at point {}, but the skin has {}", indices[i], i / 4, joints.size()));
      const Transform& joint = joints[indices[i]];
      Transform& blend = out[i / 4];
      const auto w = double{weights[i]};
      blend = {blend.x + joint.x * w, blend.y + joint.y * w, blend.z + joint.z * w, blend.t + joint.t * w};
      sums[i / 4] += weights[i];
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!(sums[i] > 0)) {
      out[i] = joints[0];
      continue;
    }
    const double scale = 1 / double{sums[i]};  // quantised weights sum to 1 but for rounding
    out[i] = {out[i].x * scale, out[i].y * scale, out[i].z * scale, out[i].t * scale};
  }
  return out;
}

void Primitive::skin(const std::vector<Transform>& joints, scene::TriangleMesh& mesh) {
  if (joints.empty() || influences_.empty()) return;
  const std::vector<Transform> to = blends(joints);
  double mirrored = 0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    mesh.points[i] = to[i].point(mesh.points[i]);
    if (!mesh.normals.empty()) mesh.normals[i] = to[i].normal(mesh.normals[i]);
    mirrored += to[i].determinant() < 0 ? 1 : -1;
    if (mesh.tangents.empty()) continue;
    std::array<float, 4>& t = mesh.tangents[i];
    const Vec3d turned = to[i].vector(Vec3d(Vec3f(t[0], t[1], t[2])));
    t = {static_cast<float>(turned.x), static_cast<float>(turned.y), static_cast<float>(turned.z), t[3]};
  }
  if (!turned_) turned_ = mirrored > 0;
  // The winding is turned with the points; the outer side stays outside.
  if (*turned_)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

scene::TriangleMesh Primitive::deformed(const Deformation& deformation) {
  scene::TriangleMesh mesh = rest_;
  morph(deformation.weights, mesh);
  skin(deformation.joints, mesh);
  if (!std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3d& p) { return all_finite(p); }))
    primitive_.fail("has points that its morph targets or its skin take to where no numbers are");
  return mesh;
}

// Whatever a file leaves out or has wrong of normals and tangents.
static void complete(scene::TriangleMesh& mesh, const PointNeeds& needs) {
  pbr::mend_normals(mesh);
  if (needs.tangents && mesh.tangents.empty()) pbr::add_tangents(mesh);
}

scene::TriangleMesh Primitive::undeformed() && {
  complete(rest_, needs_);
  return std::move(rest_);
}

scene::TriangleMesh Primitive::mesh(const Deformation& deformation) {
  scene::TriangleMesh mesh = deformed(deformation);
  complete(mesh, needs_);
  return mesh;
}

scene::MeshPose Primitive::pose(const Deformation& deformation) {
  scene::TriangleMesh posed = mesh(deformation);
  return {std::move(posed.points), std::move(posed.normals), std::move(posed.tangents)};
}

std::vector<std::array<Vec3d, 2>> Primitive::lines(const Deformation& deformation) {
  const scene::TriangleMesh mesh = deformed(deformation);
  std::vector<std::array<Vec3d, 2>> out;
  for (std::size_t i = 0; i + 1 < corners_.size(); i += 2)
    out.push_back({mesh.points[corners_[i]], mesh.points[corners_[i + 1]]});
  return out;
}

}  // namespace tyndall::gltf
