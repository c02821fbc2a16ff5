// Generated shapes of every kind, and how deep points are in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/numerics.h"
#include "generate/generated.h"

namespace tyndall::support {

// A closed one, of about a metre, about the origin.
struct GeneratedCase {
  std::string name;
  generate::Generated shape;
  // About the way to the surface, above 0 inside, of what the shape stands for; from the definitions. None:
  // there is no formula.
  std::function<double(const Vec3d&)> depth{};
  double off = 1e-9;  // how far the mesh may be from that
};

inline double across(const Vec3d& p) { return std::hypot(p.x, p.z); }

// Half a circle from the lower end of the axis to the upper one.
inline std::vector<Pair<double>> half_circle(double radius, int pieces) {
  std::vector<Pair<double>> line;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = pi * i / pieces;
    line.push_back({i == 0 || i == pieces ? 0 : radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return line;
}

// To the nearest of the balls that pass along a line.
inline double depth_of_swept(const Vec3d& p, const Vec3d& from, const Vec3d& to, double r0, double r1) {
  double most = -1e9;
  for (int i = 0; i <= 2000; ++i) {
    const double t = i / 2000.0;
    most = std::max(most, r0 + t * (r1 - r0) - length(p - (from + (to - from) * t)));
  }
  return most;
}

inline std::vector<GeneratedCase> generated_cases() {
  using namespace generate;
  const auto cylinder = [](const Vec3d& p) { return std::min({p.y + 0.5, 0.5 - p.y, 0.6 - across(p)}); };
  std::vector<GeneratedCase> cases;
  cases.push_back({"cylinder", Lathe{{{0, -0.5}, {0.6, -0.5}, {0.6, 0.5}, {0, 0.5}}}, cylinder, 6e-4});
  cases.push_back(
      {"cylinder from above", Lathe{{{0, 0.5}, {0.6, 0.5}, {0.6, -0.5}, {0, -0.5}}}, cylinder, 6e-4});
  cases.push_back({"cone", Lathe{{{0, -0.4}, {0.7, -0.4}, {0, 0.8}}},
                   [](const Vec3d& p) {
                     return std::min(p.y + 0.4,
                                     ((0.7 - across(p)) * 1.2 - 0.7 * (p.y + 0.4)) / std::hypot(1.2, 0.7));
                   },
                   6e-4});
  cases.push_back(
      {"ball", Lathe{half_circle(0.8, 8), true}, [](const Vec3d& p) { return 0.8 - length(p); }, 2e-3});
  std::vector<Pair<double>> circle;
  for (int i = 0; i <= 60; ++i)
    circle.push_back(
        {0.6 + 0.25 * std::cos(2 * pi * (i % 60) / 60), 0.25 * std::sin(2 * pi * (i % 60) / 60)});
  const auto torus = [](const Vec3d& p) { return 0.25 - std::hypot(across(p) - 0.6, p.y); };
  cases.push_back({"turned ring", Lathe{circle}, torus, 1e-3});
  const auto box_with_hole = [](const Vec3d& p) {
    const auto box = [&](double x, double z) { return std::min(x - std::abs(p.x), z - std::abs(p.z)); };
    return std::min({box(0.8, 0.6), -box(0.3, 0.2), p.y, 0.5 - p.y});
  };
  cases.push_back({"frame",
                   Prism{{{{{-0.8, -0.6}, {0.8, -0.6}, {0.8, 0.6}, {-0.8, 0.6}},
                           {{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}}}},
                         0.5},
                   box_with_hole});
  Outline star;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 0.9 : 0.35;
    star.push_back({r * std::cos(pi * i / 5), r * std::sin(pi * i / 5)});
  }
  cases.push_back({"star", Prism{{{star}}, 0.3}});
  HeightField hill;
  hill.size = {1.6, 1.2};
  hill.height = [](const Pair<double>& uv) { return 0.5 * uv.x + 0.1 * uv.y; };
  hill.resolution = 7;
  hill.floor = -0.2;
  cases.push_back({"slope", hill, [](const Vec3d& p) {
                     const double top = 0.5 * (p.x / 1.6 + 0.5) + 0.1 * (0.5 - p.z / 1.2);
                     return std::min({0.8 - std::abs(p.x), 0.6 - std::abs(p.z), p.y + 0.2, top - p.y});
                   }});
  cases.push_back({"rod", Sweep{{{-0.6, 0, 0.1}, {0.5, 0.3, -0.2}}, {{0.3}}, 64},
                   [](const Vec3d& p) {
                     return depth_of_swept(p, {-0.6, 0, 0.1}, {0.5, 0.3, -0.2}, 0.3, 0.3);
                   },
                   3e-3});
  cases.push_back({"horn", Sweep{{{-0.6, 0, 0.1}, {0.5, 0.3, -0.2}}, {{0.05, 0.4}}, 64},
                   [](const Vec3d& p) {
                     return depth_of_swept(p, {-0.6, 0, 0.1}, {0.5, 0.3, -0.2}, 0.05, 0.4);
                   },
                   4e-3});
  std::vector<Vec3d> around;
  for (int i = 0; i <= 12; ++i)
    around.push_back({0.6 * std::cos(pi * (i % 12) / 6), 0, 0.6 * std::sin(pi * (i % 12) / 6)});
  cases.push_back({"ring", Sweep{around, {{0.25}}, 64}, torus, 4e-3});
  std::vector<Vec3d> helix;
  for (int i = 0; i <= 30; ++i)
    helix.push_back({0.6 * std::cos(0.5 * i), 0.05 * i - 0.75, 0.6 * std::sin(0.5 * i)});
  cases.push_back({"spring", Sweep{helix, {{0.2}}}});  // its turns overlap
  Text text;
  text.text = "B8\noi";
  text.size = 0.8;
  text.align = Align::center;
  cases.push_back({"text", text});
  return cases;
}

// The mesh of a case.
inline generate::Made made(const generate::Generated& shape) {
  return std::visit([](const auto& s) { return s.make(); }, shape);
}

}  // namespace tyndall::support
