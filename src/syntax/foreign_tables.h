// The larger tables of foreign_words.h (internal).
#pragma once

#include "syntax/foreign_words.h"

namespace tyndall::syntax {

std::span<const ForeignWord> foreign_values();      // foreign_values.cpp
std::span<const ForeignWord> foreign_operators();   // foreign_values.cpp
std::span<const ForeignWord> foreign_parameters();  // foreign_parameters.cpp
std::span<const ForeignWord> foreign_outputs();     // foreign_parameters.cpp

}  // namespace tyndall::syntax
