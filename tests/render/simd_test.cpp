// Every SIMD class of this processor renders the same picture: the kernels fuse nothing and approximate
// nothing, so a lane's result is the same to the bit wherever it is computed, and "equal to rounding" is
// equal.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/render.h"
#include "support/scene_builder.h"
#include "support/simd_classes.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

TEST(SimdClasses, RenderTheSamePictureToTheBit) {
  SceneBuilder builder;
  builder.image(20, 14, 2).step(0.07).bounces(3).perspective({0, 0.3, 4}, {0, 0, 0}, 45).environment(0.3f);
  builder.point_light({2, 2, 2}, Rgb(20));
  MediumColors colors;
  colors.sigma_t = Rgb(3);
  colors.phase = hg(0.4f);
  builder.volume(scene::Sphere{{}, 1.2}, builder.shader(colors, [](const Point& p) {
    vm::Builder& b = *p.x.builder;
    const auto noise = [&](vm::Op op) {
      return Expression{&b, b.emit(op, {p.x.node, p.y.node, p.z.node}, {},
                                   vm::op_info(op).has(vm::OpTrait::octaves) ? 4 : 0)};
    };
    const Expression bumps = noise(vm::Op::fbm3) + exp(noise(vm::Op::cells3)) * cos(p.x * 7.f);
    // One branch costs enough to be guarded.
    const Expression inside = less(length(p), 0.9f);
    return max(Expression{&b, b.emit(vm::Op::select, {inside.node, bumps.node, p.y.node}, {})}, 0);
  }));
  builder.volume(scene::Box{{-2, -2, -2}, {2, -1, 2}}, builder.constant(colors));
  const scene::Scene scene = builder.scene;
  std::vector<float> first;
  const std::size_t classes = for_each_simd_class([&](const std::string& name) {
    const compile::CompiledScene world = compile::compile(scene);
    render::RenderOptions options;
    options.threads = 1;
    const std::vector<float> pixels = render::render(world, options).film.image().pixels;
    if (first.empty()) first = pixels;
    EXPECT_EQ(pixels, first) << name;
  });
  EXPECT_GE(classes, 2u);
  EXPECT_GT(*std::max_element(first.begin(), first.end()), 0.0f);
}

}  // namespace
}  // namespace tyndall
