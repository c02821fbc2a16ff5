// Shapes that are made into meshes from a few parameters. A member of the family is a struct of its own, with
//
//   keyword, documentation
//   closed                    whether it has an inside, or can have
//   way_to_close              what gives it one, where it can be open; empty: it never is
//   fields(f), validate()     its parameters, and what is wrong with them
//   facets()                  how many it will have, about; of a valid one
//   make()                    its mesh, with smooth normals, or why there is none
//
// Of what they are, nobody knows but who reads them: in a scene they are meshes. Where two facets of a closed
// one meet, the places of their corners are equal, bit for bit.
#pragma once

#include <variant>

#include "generate/height_field.h"
#include "generate/lathe.h"
#include "generate/prism.h"
#include "generate/sweep.h"
#include "generate/text.h"

namespace tyndall::generate {

using Generated = std::variant<Lathe, Prism, HeightField, Sweep, Text>;

}  // namespace tyndall::generate
