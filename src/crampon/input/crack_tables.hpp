#pragma once
/// Declarations of the input's tables about cracks: [[crack]] with its arc and its growth, and [fracture].

#include "crampon/input/problem.hpp"

namespace crampon {

const Declaration<CrackInput>& crack_declaration();
const Declaration<FractureInput>& fracture_declaration();

}  // namespace crampon
