#pragma once
/// A body given particle by particle.

#include <string>
#include <vector>

#include "crampon/core/error.hpp"
#include "crampon/core/vector.hpp"

namespace crampon {

struct ListedParticle {
  Vec<3> position;  ///< m; z = 0 in 2D
  double volume;    ///< m3, > 0
  Vec<3> velocity;  ///< m/s; zero when the file has none
  int line;         ///< where it stands in the file
};

struct ListedParticles {
  std::vector<ListedParticle> particles;  ///< in the order of the file, at least one
  bool has_velocity = false;
};

/// Reads a particle file of a problem in 2 or 3 dimensions:
///
///   # comment
///   x[mm], y[mm], volume[mm3], vx[m/s], vy[m/s]
///   0.25, 0.25, 0.25, 1, 0
///
/// The first line that is neither empty nor a comment names the columns, in any order: x, y, volume (3D: and z), and all or none of
/// vx, vy (3D: vz), each with its unit in brackets or in SI. Numbers in SI keep their bits (the double nearest to the text). A comment
/// runs from # to the end of the line; lines end in LF or CRLF.
/// named_at: where the input names the file; a missing file is reported there. Throws InputError with all that is wrong.
ListedParticles read_particles_csv(const std::string& path, int dimension, const Location& named_at = {});

/// The same from text already in memory; `file` is the name in diagnostics.
ListedParticles parse_particles_csv(const std::string& text, const std::string& file, int dimension);

}  // namespace crampon
