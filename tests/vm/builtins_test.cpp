// The table of built-ins is complete, sorted, and consistent with the operations.
#include "vm/program/builtins.h"

#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

TEST(Builtins, HoldEveryNameOfTheLanguage) {
  for (const std::string_view name : {"abs",
                                      "floor",
                                      "ceil",
                                      "fract",
                                      "mod",
                                      "min",
                                      "max",
                                      "clamp",
                                      "mix",
                                      "step",
                                      "smoothstep",
                                      "remap",
                                      "sqrt",
                                      "pow",
                                      "exp",
                                      "log",
                                      "sin",
                                      "cos",
                                      "tan",
                                      "asin",
                                      "acos",
                                      "atan",
                                      "atan2",
                                      "length",
                                      "distance",
                                      "dot",
                                      "cross",
                                      "normalize",
                                      "reflect",
                                      "noise",
                                      "fbm",
                                      "turbulence",
                                      "ridged",
                                      "cells",
                                      "curl",
                                      "checker",
                                      "random",
                                      "rotate_x",
                                      "rotate_y",
                                      "rotate_z",
                                      "sd_sphere",
                                      "sd_box",
                                      "sd_torus",
                                      "sd_capsule",
                                      "smooth_union",
                                      "blackbody",
                                      "luminance",
                                      "keys",
                                      "translate",
                                      "scale",
                                      "rotate",
                                      "look_at",
                                      "matrix",
                                      "direction",
                                      "image",
                                      "round",
                                      "sign",
                                      "saturate",
                                      "grid",
                                      "bounds",
                                      "append",
                                      "sort",
                                      "sum",
                                      "worley",
                                      "vnoise",
                                      "warp",
                                      "noise01",
                                      "fbm01",
                                      "turbulence01",
                                      "ridged01",
                                      "hsv",
                                      "sd_cylinder",
                                      "sd_cone",
                                      "sd_ellipsoid",
                                      "sd_plane",
                                      "smooth_max",
                                      "smooth_subtract",
                                      "sky",
                                      "print"}) {
    const Builtin* found = find_builtin(name);
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->name, name);
  }
  EXPECT_EQ(builtins().size(), 79u);
  EXPECT_EQ(find_builtin("pi"), nullptr);
  EXPECT_EQ(find_builtin(""), nullptr);
  EXPECT_EQ(find_builtin("zzz"), nullptr);
}

TEST(Builtins, AreSortedDocumentedAndFitTheirOperations) {
  std::string_view last;
  for (const Builtin& row : builtins()) {
    EXPECT_LT(last, row.name);
    last = row.name;
    EXPECT_FALSE(row.documentation.empty()) << row.name;
    EXPECT_EQ(row.documentation.back(), '.') << row.name;
    EXPECT_EQ(row.example.substr(0, row.name.size()), row.name);
    EXPECT_FALSE(row.result.empty()) << row.name;
    EXPECT_FALSE(row.parameters.empty()) << row.name;
    const std::size_t operands = static_cast<std::size_t>(op_info(row.op()).operands);
    switch (row.shape) {
      case Shape::componentwise:
      case Shape::angle_to_number:
      case Shape::number_to_angle:
        EXPECT_EQ(row.parameters.size(), operands) << row.name;
        break;
      case Shape::length:
        EXPECT_EQ(row.ops[1], Op::length3);
        break;
      case Shape::field:
        EXPECT_EQ(operands, 3u) << row.name;
        EXPECT_EQ(op_info(row.ops[1]).operands, 4) << row.name;
        EXPECT_EQ(std::any_of(row.parameters.begin(), row.parameters.end(),
                              [](const BuiltinParameter& p) { return p.name == "octaves"; }),
                  op_info(row.op()).has(OpTrait::octaves))
            << row.name;
        break;
      case Shape::vector_field:
        ASSERT_EQ(row.ops.size(), 6u) << row.name;
        for (std::size_t i = 0; i < 6; ++i)
          EXPECT_EQ(op_info(row.ops[i]).operands, i < 3 ? 3 : 4) << row.name;
        break;
      case Shape::custom:
        break;
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::vm
