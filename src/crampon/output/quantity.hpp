#pragma once
/// Numbers to colour particles by: a field, one of its components, or something derived.

#include <string>
#include <vector>

#include "crampon/output/frame.hpp"

namespace crampon {

/// One number per point.
struct PointValues {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

/// Fringe constant of N03 sec. 3.3 for stresses in MPa.
inline constexpr double paper_fringe_constant = 0.0889;

/// Understands: the name of a scalar field; "velocity" and "velocity_magnitude" (length of a vector); "velocity_x"; "stress_xx";
/// from the field "stress" what stress_measures.hpp lists, fringe_constant in 1/MPa. A field of that name wins over a derived quantity.
/// Throws std::invalid_argument with the most similar name.
PointValues evaluate_quantity(const PointFrame& frame, const std::string& name, double fringe_constant = paper_fringe_constant);

/// Are its numbers names of things, as those of bodies and materials are?
bool is_category(const PointFrame& frame, const std::string& name);

/// All names evaluate_quantity understands for this frame.
std::vector<std::string> quantity_names(const PointFrame& frame);

}  // namespace crampon
