#pragma once
/// Frames as VTK poly data files that ParaView opens and that this program reads back.

#include <filesystem>

#include "crampon/output/frame.hpp"

namespace crampon {

/// Points as vertex cells with every field as point data; time, step, dimension, cell size, names of bodies
/// and places of rigid bodies as field data. Fields "id", "body",
/// "material", "node", "velocity_field" and "crack" that hold whole numbers are stored as Int64 in both precisions.
/// Throws std::runtime_error (path and reason; no file is left) and std::invalid_argument for a field of a wrong length.
void write_vtp(const std::filesystem::path& path, PointFrame frame, Precision precision = Precision::single);

/// Three polylines per crack: the plane and its two surfaces, told apart by the cell data "surface" (0 plane, 1 upper, 2 lower) and
/// "crack" (index into the names in the field data). Vertex fields are repeated on all three. Errors as above.
void write_vtp(const std::filesystem::path& path, CrackFrame frame, Precision precision = Precision::single);

/// Reads what write_vtp wrote. Throws std::runtime_error "path: reason" when the file is missing, damaged (every file carries a
/// checksum) or of the other kind.
PointFrame read_vtp(const std::filesystem::path& path);
CrackFrame read_crack_vtp(const std::filesystem::path& path);

}  // namespace crampon
