#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/output/vtk_xml.hpp"

namespace crampon {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are declared LittleEndian");

constexpr std::size_t block_bytes = std::size_t{1} << 18;

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

const char* type_name(NumberType type) {
  switch (type) {
    case NumberType::float32:
      return "Float32";
    case NumberType::float64:
      return "Float64";
    case NumberType::int32:
      return "Int32";
    case NumberType::int64:
      break;
  }
  return "Int64";
}

void append_word(std::string& out, std::uint64_t word) {
  char bytes[8];
  std::memcpy(bytes, &word, 8);
  out.append(bytes, 8);
}

/// first, first + 1, ... n of them.
Numbers counted(std::size_t first, std::size_t n) {
  Numbers out(NumberType::int32, n, 1, 1);
  for (std::size_t i = 0; i < n; ++i) out.set(i, static_cast<double>(first + i));
  return out;
}

/// Packs arrays in blocks, as the files want them.
class Compressor {
 public:
  Compressor() : state_(libdeflate_alloc_compressor(level)) {
    if (!state_) throw std::bad_alloc();
  }

  /// Appends number of blocks, bytes of a block, bytes of the last block when shorter (else 0), compressed bytes of each; then the blocks,
  /// a piece each. Returns the size of all that.
  std::size_t append(std::vector<std::string>& pieces, const Numbers& numbers) {
    const std::size_t bytes = numbers.bytes(), head_at = pieces.size();
    std::string head;
    append_word(head, (bytes + block_bytes - 1) / block_bytes);
    append_word(head, block_bytes);
    append_word(head, bytes % block_bytes);
    pieces.emplace_back();
    std::size_t total = 0;
    for (std::size_t from = 0; from < bytes; from += block_bytes) {
      const std::span<const char> raw = numbers.block(from, std::min(block_bytes, bytes - from), raw_room_);
      packed_room_.resize(libdeflate_zlib_compress_bound(state_.get(), raw.size()));
      const std::size_t packed = libdeflate_zlib_compress(state_.get(), raw.data(), raw.size(), packed_room_.data(), packed_room_.size());
      if (packed == 0) throw std::logic_error("a block does not fit the room that libdeflate asked for");
      append_word(head, packed);
      pieces.emplace_back(packed_room_.data(), packed);
      total += packed;
    }
    total += head.size();
    pieces[head_at] = std::move(head);
    return total;
  }

 private:
  /// Particle data are noise in their low bits: higher levels cost several times the time for a few per cent.
  static constexpr int level = 1;
  struct Free {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
  };
  std::unique_ptr<libdeflate_compressor, Free> state_;
  std::vector<char> raw_room_, packed_room_;
};

const char* const axis_names[] = {"X", "Y", "Z"};
const char* const tensor_names[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

std::string open_tag(const DataArray& array) {
  std::string tag = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type_name(array.values.type()),
                                escape(array.name), array.components);
  const char* const* names = array.components == 3 ? axis_names : array.components == 6 ? tensor_names : nullptr;
  for (int k = 0; names && k < array.components; ++k) tag += fmt::format(" ComponentName{}=\"{}\"", k, names[k]);
  return tag;
}

class Document {
 public:
  void line(std::string_view text) { (xml_ += text) += '\n'; }
  void array(DataArray& a) {
    line(fmt::format("{} format=\"appended\" offset=\"{}\">", open_tag(a), appended_bytes_));
    if (!a.unit.empty())
      line(fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>", escape(a.unit)));
    line("</DataArray>");
    appended_bytes_ += compressor_.append(pieces_, a.values);
    a.values = Numbers();
  }
  void text_array(const DataArray& a) {
    line(fmt::format("{} NumberOfTuples=\"{}\" format=\"ascii\">", open_tag(a), a.values.size() / static_cast<std::size_t>(a.components)));
    for (const double v : a.values) {
      if (a.values.type() == NumberType::int64)
        line(fmt::format("{}", static_cast<std::int64_t>(v)));
      else
        line(fmt::format("{:.17g}", v));
    }
    line("</DataArray>");
  }
  void strings(const std::string& name, const std::vector<std::string>& list) {
    line(fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">", escape(name), list.size()));
    for (const std::string& s : list) {
      std::string codes;
      for (const char c : s) codes += fmt::format("{} ", static_cast<int>(c));  // VTK reads signed characters
      line(codes + "0");
    }
    line("</Array>");
  }
  /// Cells that take all points one after another.
  void cells(const char* section, std::size_t points, Numbers&& ends) {
    line(fmt::format("<{}>", section));
    DataArray connectivity{"connectivity", "", 1, counted(0, points)}, offsets{"offsets", "", 1, std::move(ends).as(NumberType::int32)};
    array(connectivity);
    array(offsets);
    line(fmt::format("</{}>", section));
  }
  std::vector<std::string> finish() {
    line("<AppendedData encoding=\"raw\">");
    xml_ += '_';
    pieces_.front() = std::move(xml_);
    pieces_.emplace_back("\n</AppendedData>\n</VTKFile>\n");
    std::uint32_t crc = 0;
    for (const std::string& piece : pieces_) crc = libdeflate_crc32(crc, piece.data(), piece.size());
    pieces_.push_back(fmt::format("<!-- crc32 {:08x} -->\n", crc));
    return std::move(pieces_);
  }

 private:
  std::string xml_;
  std::vector<std::string> pieces_{1};  // the first is for the XML before the appended data
  std::size_t appended_bytes_ = 0;
  Compressor compressor_;
};

void check_length(const DataArray& a, std::size_t items, const char* what) {
  if (a.components < 1 || a.values.size() != items * static_cast<std::size_t>(a.components))
    throw std::invalid_argument(fmt::format("field \"{}\" has {} values, but {} {} of {} components need {}", a.name, a.values.size(),
                                            items, what, a.components, items * a.components));
}

}  // namespace

std::vector<std::string> encode_poly_data(PolyData data) {
  const std::size_t points = data.points.values.size() / 3;
  check_length(data.points, points, "points");
  const std::size_t vertices = data.vertices, lines = data.line_ends.size();
  for (const DataArray& a : data.point_data) check_length(a, points, "points");
  for (const DataArray& a : data.cell_data) check_length(a, vertices + lines, "cells");

  Document doc;
  doc.line("<?xml version=\"1.0\"?>");
  doc.line(
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">");
  doc.line("<PolyData>");
  doc.line("<FieldData>");
  for (const DataArray& a : data.field_data) doc.text_array(a);
  if (!data.string_name.empty()) doc.strings(data.string_name, data.strings);
  doc.line("</FieldData>");
  doc.line(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"0\">",
                  points, vertices, lines));
  doc.line("<PointData>");
  for (DataArray& a : data.point_data) doc.array(a);
  doc.line("</PointData>");
  doc.line("<CellData>");
  for (DataArray& a : data.cell_data) doc.array(a);
  doc.line("</CellData>");
  doc.line("<Points>");
  doc.array(data.points);
  doc.line("</Points>");
  doc.cells("Verts", vertices, counted(1, vertices));
  doc.cells("Lines", lines == 0 ? 0 : points, std::move(data.line_ends));
  doc.line("</Piece>");
  doc.line("</PolyData>");
  return doc.finish();
}

}  // namespace crampon
