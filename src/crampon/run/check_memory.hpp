#pragma once
/// Does a problem fit into memory? Told from the input alone, before anything is made from it.

#include "crampon/input/problem.hpp"

namespace crampon {

/// What the arrays of a problem take, bytes, from the measures of its shapes: good to some ten per cent. Particles from files are not
/// counted.
struct MemoryNeed {
  double grid = 0;                ///< what there is of the grid where no body is
  double conditions = 0;          ///< nodes of boundaries and symmetry planes
  std::vector<double> particles;  ///< per body, then per rigid body: numbers of particles
  std::vector<double> bodies;     ///< their bytes, with the nodes about them
  double total() const;
};
MemoryNeed estimate_memory(const Problem& problem);

/// Memory that this process may still take, bytes: free in the system, and within the limits set to it.
double free_memory_bytes();

/// Throws InputError at what takes most when the problem needs more than `available` bytes, or more particles than can be numbered.
void check_memory(const Problem& problem, double available = free_memory_bytes());

}  // namespace crampon
