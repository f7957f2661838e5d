#pragma once
/// Declarations of the input's tables about cracks: [[crack]] with its arc and its growth, [fracture], and [[nucleation]].

#include "crampon/input/problem.hpp"

namespace crampon {

const Declaration<CrackInput>& crack_declaration();
const Declaration<FractureInput>& fracture_declaration();
const Declaration<NucleationInput>& nucleation_declaration();

}  // namespace crampon
