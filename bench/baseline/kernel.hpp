#pragma once
/// A yardstick of speed: an elastic block with nothing but the loops of the step, without cracks, contact, conditions or re-ordering. What
/// the engine costs beyond it is the price of its features. It stands on core alone, so that a change of the engine's loops does not move it.

#include <cstddef>
#include <cstdint>
#include <memory>

namespace crampon::bench {

enum class Scheme { usf, usavg };
enum class Stencil { linear, gimp };

class Kernel {
 public:
  virtual ~Kernel() = default;
  /// One time step. Throws std::runtime_error when a particle has drifted a cell out of its block: blocks are never ordered anew.
  virtual void step() = 0;
  virtual std::size_t particles() const = 0;
  virtual double kinetic_energy() const = 0;  ///< J
  /// Of the bits of all positions and velocities: the same for any number of threads.
  virtual std::uint64_t hash() const = 0;
};

/// cells: of 1 m along each side, 4 particles in each; blocks of 8 x 8 cells. Throws std::bad_alloc.
std::unique_ptr<Kernel> make_block2d(int cells, Scheme scheme, Stencil stencil, int threads);
/// The same with 8 particles in each cell and blocks of 8 x 8 x 8 cells.
std::unique_ptr<Kernel> make_block3d(int cells, Scheme scheme, Stencil stencil, int threads);

}  // namespace crampon::bench
