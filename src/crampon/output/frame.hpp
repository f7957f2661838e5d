#pragma once
/// Snapshots of a run in plain arrays: what the writers and the pictures work from. Nothing here knows the engine.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "crampon/output/numbers.hpp"

namespace crampon {

/// One quantity on particles, nodes or crack vertices: row-major, components values per item.
/// Symmetric tensors have 6 components in the order xx, yy, zz, xy, yz, xz; vectors 3.
struct DataArray {
  std::string name;
  std::string unit;
  int components = 1;
  Numbers values;
};

/// Where a rigid body or wall is: the point that began at X is at centre + turn (X - start).
struct RigidPlace {
  std::array<double, 3> start{}, centre{};                ///< its centre at the start and now, m
  std::array<double, 9> turn{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< by rows
};

/// A set of points (particles or nodes) with fields; points in the order of their ids, so that frames can be compared.
struct PointFrame {
  double time = 0;  ///< s
  std::int64_t step = 0;
  int dimension = 2;
  Numbers positions;                    ///< 3 per point, m
  std::vector<DataArray> fields;        ///< particles always have "id" and "body"
  std::vector<std::string> body_names;  ///< what the numbers in "body" stand for; empty for nodes
  std::vector<RigidPlace> rigid;        ///< rigid bodies, then walls, in the order of the input; empty for nodes
  double cell = 0;                      ///< grid spacing, m (largest axis), for drawing
  Numbers particle_size;                ///< edge lengths of an undeformed particle, 3 per point, m; may be empty (nodes)
};

/// All cracks at one time. Vertices of crack k are [begin[k], begin[k + 1]).
struct CrackFrame {
  double time = 0;
  std::int64_t step = 0;
  std::vector<std::string> names;
  std::vector<std::int64_t> begin{0};
  std::vector<double> plane, upper, lower;  ///< 3 per vertex, m: the crack plane and its two surfaces
  std::vector<DataArray> fields;            ///< per vertex: "opening" and "sliding" (m), ...
  std::vector<double> original;             ///< 3 per vertex, m: where the vertex began, for drawing magnified; may be empty
};

/// One column of history.csv.
struct HistoryColumn {
  std::string name;  ///< "strain_energy", "momentum_x", "opening_max.crack1", "reaction_y.left", "probe.velocity_x"
  std::string unit;
};

}  // namespace crampon
