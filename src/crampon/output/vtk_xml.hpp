#pragma once
/// VTK XML PolyData files (.vtp), raw appended, zlib-compressed, 64-bit headers: what vtp.cpp stores frames in.
/// Layout after the "VTK XML Formats" description; a CRC-32 of the file follows as a comment, which VTK and ParaView skip.

#include <string>
#include <string_view>
#include <vector>

#include "crampon/output/frame.hpp"

namespace crampon {

/// A poly data set of one piece. Arrays are stored as the type they have; units as VTK's own UNITS_LABEL.
struct PolyData {
  std::vector<DataArray> field_data;  ///< stored as text, so a person can read the time in an editor
  std::string string_name;            ///< one array of strings in the field data; empty: none
  std::vector<std::string> strings;
  DataArray points;  ///< 3 components
  std::vector<DataArray> point_data, cell_data;
  std::size_t vertices = 0;  ///< the first so many points are a cell each
  Numbers line_ends;         ///< lines run through all points one after another: past the last point of each
};

/// The file, in pieces to be written one after another. Throws std::invalid_argument when an array's length does not fit the number of
/// points or cells. Frees each array once it is encoded.
std::vector<std::string> encode_poly_data(PolyData data);

/// Reads what encode_poly_data wrote. Throws std::runtime_error that says what is damaged.
PolyData decode_poly_data(std::string_view bytes);

}  // namespace crampon
