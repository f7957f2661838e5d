#pragma once
/// VTK XML PolyData files (.vtp), raw appended, zlib-compressed, 64-bit headers: what vtp.cpp stores frames in.
/// Layout after the "VTK XML Formats" description; a CRC-32 of the file follows as a comment, which VTK and ParaView skip.

#include <string>
#include <string_view>
#include <vector>

namespace crampon {

enum class VtkType { float32, float64, int32, int64 };

/// One data array; values are converted to `type` when written.
struct VtkArray {
  std::string name;
  std::string unit;  ///< stored as VTK's own UNITS_LABEL
  int components = 1;
  VtkType type = VtkType::float64;
  std::vector<double> values;
};

/// A poly data set of one piece. Cells are given by connectivity (point of each corner) and offsets (end of each cell).
struct PolyData {
  std::vector<VtkArray> field_data;  ///< stored as text, so a person can read the time in an editor
  std::string string_name;           ///< one array of strings in the field data; empty: none
  std::vector<std::string> strings;
  VtkArray points;  ///< 3 components
  std::vector<VtkArray> point_data, cell_data;
  std::vector<double> vertex_connectivity, vertex_offsets;
  std::vector<double> line_connectivity, line_offsets;
};

/// The bytes of the file. Throws std::invalid_argument when an array's length does not fit the number of points or cells.
/// Frees each array once it is encoded.
std::string encode_poly_data(PolyData data);

/// Reads what encode_poly_data wrote. Throws std::runtime_error that says what is damaged.
PolyData decode_poly_data(std::string_view bytes);

}  // namespace crampon
