// Noise and its like far from 0: every member of the family is told, with its place, and none near by.
#include "compile/coarse_fields.h"

#include <gtest/gtest.h>

#include <string>

#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall::compile {
namespace UNNAMED {

const std::string camera = "camera perspective { from: (0, 0, 5)  to: (0, 0, 0) }\n";

// Calls of every field of a lattice.
const std::pair<const char*, const char*> fields[] = {
    {"noise", "noise($PLACE)"},
    {"noise", "noise($PLACE, time: time)"},
    {"fbm", "fbm($PLACE, octaves: 2)"},
    {"turbulence", "turbulence($PLACE, time: time, octaves: 2)"},
    {"ridged", "ridged($PLACE)"},
    {"cells", "cells($PLACE)"},
    {"cells", "cells($PLACE, time: time)"},
    {"curl", "curl($PLACE).y"},
    {"curl", "curl($PLACE, time: time).x"},
    {"worley", "worley($PLACE).x"},
    {"worley", "worley($PLACE).y"},
    {"worley", "worley($PLACE).z"},
    {"worley", "worley($PLACE, time: time).x"},
    {"worley", "worley($PLACE, time: time).y"},
    {"worley", "worley($PLACE, time: time).z"},
    {"checker", "(if checker(($PLACE).xy) then 1 else 0)"},
};

TEST(CoarseFields, EveryMemberOfTheFamilyIsTold) {
  std::size_t ops = 0;
  for (int op = 0; op < vm::op_count; ++op)
    ops += vm::op_info(static_cast<vm::Op>(op)).has(vm::OpTrait::lattice);
  EXPECT_EQ(ops, 23u) << "a new member wants a row above";
  for (const auto& [name, text] : fields)
    for (const bool material : {false, true})
      for (const auto& [place, coarse] :
           {std::pair{"p * 3", false}, {"p * 1e5", false}, {"p * 1e7", true}, {"P + (3e6, 0, 0)", true}}) {
        const std::string call = support::filled(text, {{"PLACE", place}});
        const CompiledScene world = compile(support::scene_of(
            camera +
            support::filled(
                material ? "sphere { material: { base_color = 0.5 + 0.1 * $CALL } }"
                         : "volume { in: sphere {}  medium: { density = 0.5 + 0.1 * $CALL  albedo = 0.5 } }",
                {{"CALL", call}})));
        ASSERT_EQ(world.coarse_fields.size(), coarse) << call;
        if (!coarse) continue;
        EXPECT_EQ(world.coarse_fields[0].name, name);
        EXPECT_GT(world.coarse_fields[0].reach, coarse_place);
        EXPECT_TRUE(world.coarse_fields[0].span.valid());
      }
}

// A shape without bounds has places without bounds.
TEST(CoarseFields, APlaneIsNotLookedAt) {
  const CompiledScene world = compile(support::scene_of(
      camera +
      "plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 + 0.1 * noise(p) } }\n"));
  EXPECT_TRUE(world.coarse_fields.empty());
}

}  // namespace UNNAMED
}  // namespace tyndall::compile
