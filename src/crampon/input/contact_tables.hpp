#pragma once
/// Declarations of the input's tables about contact: [contact], [[contact_pair]], [[rigid]], [[wall]].

#include "crampon/input/problem.hpp"

namespace crampon {

const Declaration<ContactInput>& contact_declaration();
const Declaration<ContactPairInput>& contact_pair_declaration();
const Declaration<RigidInput>& rigid_declaration();
const Declaration<WallInput>& wall_declaration();

}  // namespace crampon
