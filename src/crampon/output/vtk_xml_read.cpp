#include <libdeflate.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/output/vtk_xml.hpp"

namespace crampon {
namespace {

[[noreturn]] void damaged(const std::string& what) { throw std::runtime_error("damaged file: " + what); }

std::string unescape(std::string_view text) {
  static const std::pair<std::string_view, char> entities[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}};
  std::string out;
  while (!text.empty()) {
    bool found = false;
    for (const auto& [entity, c] : entities) {
      if (text.substr(0, entity.size()) != entity) continue;
      out += c;
      text.remove_prefix(entity.size());
      found = true;
      break;
    }
    if (found) continue;
    out += text.front();
    text.remove_prefix(1);
  }
  return out;
}

struct Tag {
  std::string name;  // "Points", "/Points", ...
  std::map<std::string, std::string, std::less<>> attributes;
  std::string text;  // up to the next tag

  const std::string& attribute(std::string_view key) const {
    const auto found = attributes.find(key);
    if (found == attributes.end()) damaged(fmt::format("<{}> has no attribute {}", name, key));
    return found->second;
  }
  std::size_t count(std::string_view key) const {
    const std::string& digits = attribute(key);
    std::size_t value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc() || end != digits.data() + digits.size()) damaged(fmt::format("{} = \"{}\" is no count", key, digits));
    return value;
  }
};

// The tags of the header one after another; enough of XML for the files written here.
class TagReader {
 public:
  explicit TagReader(std::string_view text) : rest_(text) {}

  std::optional<Tag> next() {
    const std::size_t open = rest_.find('<');
    if (open == std::string_view::npos) return std::nullopt;
    const std::size_t close = rest_.find('>', open);
    if (close == std::string_view::npos) damaged("a tag has no end");
    Tag tag = parse(rest_.substr(open + 1, close - open - 1));
    rest_.remove_prefix(close + 1);
    tag.text = rest_.substr(0, rest_.find('<'));
    return tag;
  }

 private:
  static Tag parse(std::string_view inside) {
    Tag tag;
    const std::size_t end = inside.find(' ');
    tag.name = inside.substr(0, end);
    inside.remove_prefix(end == std::string_view::npos ? inside.size() : end);
    for (;;) {
      const std::size_t equal = inside.find("=\"");
      if (equal == std::string_view::npos) return tag;
      const std::size_t quote = inside.find('"', equal + 2);
      if (quote == std::string_view::npos) damaged("an attribute has no end");
      const std::size_t start = inside.find_first_not_of(' ');
      tag.attributes.emplace(inside.substr(start, equal - start), unescape(inside.substr(equal + 2, quote - equal - 2)));
      inside.remove_prefix(quote + 1);
    }
  }

  std::string_view rest_;
};

std::uint64_t read_word(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < 8) damaged("a data block lies outside the file");
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, 8);
  return word;
}

std::string decompress(std::string_view appended, std::size_t at) {
  const std::uint64_t blocks = read_word(appended, at), block = read_word(appended, at + 8), last = read_word(appended, at + 16);
  if (blocks > appended.size() / 8) damaged("a data array claims more blocks than the file can hold");
  std::size_t body = at + 24 + 8 * blocks;
  std::string raw;
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> unpack(libdeflate_alloc_decompressor(),
                                                                                            libdeflate_free_decompressor);
  if (!unpack) throw std::bad_alloc();
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t packed = read_word(appended, at + 24 + 8 * b);
    const std::uint64_t size = b + 1 == blocks && last != 0 ? last : block;
    if (body > appended.size() || packed > appended.size() - body) damaged("a data block lies outside the file");
    if (size / 1100 > packed + 1) damaged("a data block claims more than can be packed");  // deflate packs at most 1032 to 1
    const std::size_t old = raw.size();
    raw.resize(old + size);
    std::size_t found = 0;
    const auto code = libdeflate_zlib_decompress(unpack.get(), appended.data() + body, packed, raw.data() + old, size, &found);
    if (code != LIBDEFLATE_SUCCESS || found != size) damaged("a data block does not decompress");
    body += packed;
  }
  return raw;
}

NumberType type_of(const std::string& name) {
  if (name == "Float32") return NumberType::float32;
  if (name == "Float64") return NumberType::float64;
  if (name == "Int32") return NumberType::int32;
  if (name == "Int64") return NumberType::int64;
  damaged("unknown data type " + name);
}

DataArray read_array(const Tag& tag, std::string_view appended) {
  DataArray array;
  array.name = tag.attribute("Name");
  array.components = static_cast<int>(tag.count("NumberOfComponents"));
  if (array.components < 1) damaged("array " + array.name + " has no components");
  const NumberType type = type_of(tag.attribute("type"));
  if (tag.attribute("format") == "ascii") {
    array.values = Numbers(type);
    const char* p = tag.text.c_str();
    const std::size_t count = tag.count("NumberOfTuples") * static_cast<std::size_t>(array.components);
    for (std::size_t i = 0; i < count; ++i) {
      char* end = nullptr;
      array.values.push_back(std::strtod(p, &end));
      if (end == p) damaged("array " + array.name + " is too short");
      p = end;
    }
    return array;
  }
  const std::string raw = decompress(appended, tag.count("offset"));
  array.values = Numbers(type, raw);
  if (array.values.bytes() != raw.size()) damaged("a data array ends within a value");
  return array;
}

std::vector<std::string> read_strings(const Tag& tag) {
  std::vector<std::string> list(1);
  const char* p = tag.text.c_str();
  const std::size_t wanted = tag.count("NumberOfTuples");
  while (list.size() <= wanted) {
    char* end = nullptr;
    const long code = std::strtol(p, &end, 10);
    if (end == p) damaged("the list of names is too short");
    p = end;
    if (code == 0)
      list.emplace_back();
    else
      list.back() += static_cast<char>(code);
  }
  list.pop_back();
  return list;
}

// The comment with the checksum is the last line; without it the file was cut off.
std::string_view checked(std::string_view bytes) {
  constexpr std::string_view start = "<!-- crc32 ", end = " -->\n";
  constexpr std::size_t length = start.size() + 8 + end.size();
  if (bytes.size() < length || bytes.substr(bytes.size() - length, start.size()) != start || bytes.substr(bytes.size() - end.size()) != end)
    damaged("it ends too early, or Crampon did not write it");
  const std::string_view digits = bytes.substr(bytes.size() - length + start.size(), 8);
  std::uint32_t stored = 0;
  const auto [stop, code] = std::from_chars(digits.data(), digits.data() + 8, stored, 16);
  bytes.remove_suffix(length);
  const std::uint32_t crc = libdeflate_crc32(0, bytes.data(), bytes.size());
  if (code != std::errc() || stop != digits.data() + 8 || stored != crc) damaged("its checksum does not fit its content");
  return bytes;
}

void check_count(const DataArray& a, std::size_t items) {
  if (a.values.size() != items * static_cast<std::size_t>(a.components)) damaged("array " + a.name + " has a wrong length");
}

}  // namespace

PolyData decode_poly_data(std::string_view bytes) {
  bytes = checked(bytes);
  constexpr std::string_view marker = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t mark = bytes.find(marker);
  if (mark == std::string_view::npos) damaged("it has no appended data");
  const std::string_view appended = bytes.substr(mark + marker.size());

  PolyData data;
  std::size_t points = 0, cells = 0;
  std::string section;
  DataArray* last = nullptr;
  DataArray discarded;
  TagReader tags(bytes.substr(0, mark));
  while (std::optional<Tag> tag = tags.next()) {
    if (tag->name == "Piece") {
      points = tag->count("NumberOfPoints");
      data.vertices = tag->count("NumberOfVerts");
      cells = data.vertices + tag->count("NumberOfLines");
    } else if (tag->name == "Array") {
      data.string_name = tag->attribute("Name");
      data.strings = read_strings(*tag);
    } else if (tag->name == "InformationKey") {
      if (last) last->unit = unescape(tag->text);
    } else if (tag->name == "DataArray") {
      DataArray array = read_array(*tag, appended);
      last = &discarded;
      if (section == "FieldData")
        last = &data.field_data.emplace_back(std::move(array));
      else if (section == "PointData")
        last = &data.point_data.emplace_back(std::move(array));
      else if (section == "CellData")
        last = &data.cell_data.emplace_back(std::move(array));
      else if (section == "Points")
        *(last = &data.points) = std::move(array);
      else if (section == "Lines" && array.name == "offsets")
        data.line_ends = std::move(array.values);
    } else if (!tag->name.starts_with('/')) {
      section = tag->name;
    }
  }
  if (data.points.components != 3) damaged("its points have no three coordinates");
  check_count(data.points, points);
  for (const DataArray& a : data.point_data) check_count(a, points);
  for (const DataArray& a : data.cell_data) check_count(a, cells);
  return data;
}

}  // namespace crampon
