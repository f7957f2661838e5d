#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
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

const char* type_name(VtkType type) {
  switch (type) {
    case VtkType::float32:
      return "Float32";
    case VtkType::float64:
      return "Float64";
    case VtkType::int32:
      return "Int32";
    case VtkType::int64:
      break;
  }
  return "Int64";
}

template <class T>
std::string raw_as(const std::vector<double>& values) {
  std::string raw(values.size() * sizeof(T), '\0');
  char* to = raw.data();
  for (const double v : values) {
    const T t = static_cast<T>(v);
    std::memcpy(to, &t, sizeof(T));
    to += sizeof(T);
  }
  return raw;
}

std::string raw_bytes(const VtkArray& array) {
  switch (array.type) {
    case VtkType::float32:
      return raw_as<float>(array.values);
    case VtkType::float64:
      return raw_as<double>(array.values);
    case VtkType::int32:
      return raw_as<std::int32_t>(array.values);
    case VtkType::int64:
      break;
  }
  return raw_as<std::int64_t>(array.values);
}

void append_word(std::string& out, std::uint64_t word) {
  char bytes[8];
  std::memcpy(bytes, &word, 8);
  out.append(bytes, 8);
}

/// Packs arrays in blocks, as the files want them.
class Compressor {
 public:
  Compressor() : state_(libdeflate_alloc_compressor(level)) {
    if (!state_) throw std::bad_alloc();
  }

  /// Appends number of blocks, bytes of a block, bytes of the last block when shorter (else 0), compressed bytes of each; then the blocks.
  void append(std::string& out, const std::string& raw) const {
    const std::size_t blocks = (raw.size() + block_bytes - 1) / block_bytes;
    append_word(out, blocks);
    append_word(out, block_bytes);
    append_word(out, raw.size() % block_bytes);
    std::size_t size_at = out.size();
    out.resize(out.size() + 8 * blocks);
    for (std::size_t from = 0; from < raw.size(); from += block_bytes, size_at += 8) {
      const std::size_t size = std::min(block_bytes, raw.size() - from), end = out.size();
      const std::size_t room = libdeflate_zlib_compress_bound(state_.get(), size);
      out.resize(end + room);
      const std::uint64_t packed = libdeflate_zlib_compress(state_.get(), raw.data() + from, size, out.data() + end, room);
      if (packed == 0) throw std::logic_error("a block does not fit the room that libdeflate asked for");
      out.resize(end + packed);
      std::memcpy(out.data() + size_at, &packed, 8);
    }
  }

 private:
  /// Particle data are noise in their low bits: higher levels cost several times the time for a few per cent.
  static constexpr int level = 1;
  struct Free {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
  };
  std::unique_ptr<libdeflate_compressor, Free> state_;
};

const char* const axis_names[] = {"X", "Y", "Z"};
const char* const tensor_names[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

std::string open_tag(const VtkArray& array) {
  std::string tag = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type_name(array.type), escape(array.name),
                                array.components);
  const char* const* names = array.components == 3 ? axis_names : array.components == 6 ? tensor_names : nullptr;
  for (int k = 0; names && k < array.components; ++k) tag += fmt::format(" ComponentName{}=\"{}\"", k, names[k]);
  return tag;
}

class Document {
 public:
  void line(std::string_view text) { (xml_ += text) += '\n'; }
  void array(VtkArray& a) {
    line(fmt::format("{} format=\"appended\" offset=\"{}\">", open_tag(a), appended_.size()));
    if (!a.unit.empty())
      line(fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>", escape(a.unit)));
    line("</DataArray>");
    compressor_.append(appended_, raw_bytes(a));
    std::vector<double>().swap(a.values);
  }
  void text_array(const VtkArray& a) {
    line(fmt::format("{} NumberOfTuples=\"{}\" format=\"ascii\">", open_tag(a), a.values.size()));
    for (const double v : a.values) {
      if (a.type == VtkType::int64)
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
  void cells(const char* section, std::vector<double>&& connectivity, std::vector<double>&& offsets) {
    line(fmt::format("<{}>", section));
    VtkArray points{"connectivity", "", 1, VtkType::int32, std::move(connectivity)},
        ends{"offsets", "", 1, VtkType::int32, std::move(offsets)};
    array(points);
    array(ends);
    line(fmt::format("</{}>", section));
  }
  std::string finish() {
    line("<AppendedData encoding=\"raw\">");
    xml_ += '_';
    xml_ += appended_;
    xml_ += "\n</AppendedData>\n</VTKFile>\n";
    const std::uint32_t crc = libdeflate_crc32(0, xml_.data(), xml_.size());
    xml_ += fmt::format("<!-- crc32 {:08x} -->\n", crc);
    return std::move(xml_);
  }

 private:
  std::string xml_, appended_;
  Compressor compressor_;
};

void check_length(const VtkArray& a, std::size_t items, const char* what) {
  if (a.components < 1 || a.values.size() != items * static_cast<std::size_t>(a.components))
    throw std::invalid_argument(fmt::format("field \"{}\" has {} values, but {} {} of {} components need {}", a.name, a.values.size(),
                                            items, what, a.components, items * a.components));
}

}  // namespace

std::string encode_poly_data(PolyData data) {
  const std::size_t points = data.points.values.size() / 3;
  check_length(data.points, points, "points");
  const std::size_t vertices = data.vertex_offsets.size(), lines = data.line_offsets.size();
  for (const VtkArray& a : data.point_data) check_length(a, points, "points");
  for (const VtkArray& a : data.cell_data) check_length(a, vertices + lines, "cells");

  Document doc;
  doc.line("<?xml version=\"1.0\"?>");
  doc.line(
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">");
  doc.line("<PolyData>");
  doc.line("<FieldData>");
  for (const VtkArray& a : data.field_data) doc.text_array(a);
  if (!data.string_name.empty()) doc.strings(data.string_name, data.strings);
  doc.line("</FieldData>");
  doc.line(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"0\">",
                  points, vertices, lines));
  doc.line("<PointData>");
  for (VtkArray& a : data.point_data) doc.array(a);
  doc.line("</PointData>");
  doc.line("<CellData>");
  for (VtkArray& a : data.cell_data) doc.array(a);
  doc.line("</CellData>");
  doc.line("<Points>");
  doc.array(data.points);
  doc.line("</Points>");
  doc.cells("Verts", std::move(data.vertex_connectivity), std::move(data.vertex_offsets));
  doc.cells("Lines", std::move(data.line_connectivity), std::move(data.line_offsets));
  doc.line("</Piece>");
  doc.line("</PolyData>");
  return doc.finish();
}

}  // namespace crampon
