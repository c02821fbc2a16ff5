// What must hold of things made without text.
#include <gtest/gtest.h>

#include "scene/validate.h"

namespace tyndall::scene {
namespace UNNAMED {

TEST(Validate, DefaultsAreSound) {
  EXPECT_TRUE(validate(RenderSettings{}).empty());
  EXPECT_TRUE(validate(Animation{}).empty());
  EXPECT_TRUE(validate(PerspectiveCamera{}).empty());
  EXPECT_TRUE(validate(OrthographicCamera{}).empty());
  EXPECT_TRUE(validate(Sphere{}).empty());
}

// Not-a-number fails every range.
TEST(Validate, RefusesNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(validate(Sphere{{}, nan}).empty());
  EXPECT_FALSE(validate(Box{{0, 0, 0}, {1, nan, 1}}).empty());
  EXPECT_FALSE(validate(shapes::Plane{{}, {nan, 0, 0}}).empty());
  EXPECT_FALSE(validate(Quad{{}, {1, 0, 0}, {0, nan, 0}}).empty());
  RenderSettings settings;
  settings.step = nan;
  EXPECT_FALSE(validate(settings).empty());
  PerspectiveCamera camera;
  camera.fov.radians = nan;
  EXPECT_FALSE(validate(camera).empty());
  EXPECT_FALSE(validate(scene::PointLight{{}, Rgb(static_cast<float>(nan)), {}}).empty());
}

// The extremes of the pictures' sides are allowed, one more is not.
TEST(Validate, ResolutionIsBounded) {
  const auto problems = [](int width, int height) {
    RenderSettings settings;
    settings.resolution.width = width;
    settings.resolution.height = height;
    return validate(settings).size();
  };
  EXPECT_EQ(problems(1, 16384), 0u);
  EXPECT_EQ(problems(16385, 1), 1u);
  EXPECT_EQ(problems(1, 0), 1u);
}

// Names in problems are those of the fields: resolve finds the parameter's place by them.
TEST(Validate, NamesTheField) {
  const Problems problems = validate(scene::AreaLight{scene::Sphere{{}, -1}, Rgb(-1, 0, 0), {}});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].field, "radius");
  EXPECT_EQ(problems[1].field, "power");
}

}  // namespace
}  // namespace tyndall::scene
