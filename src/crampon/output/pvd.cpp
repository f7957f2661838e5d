#include "crampon/output/pvd.hpp"

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "crampon/output/file.hpp"

namespace crampon {
namespace {

std::optional<std::string> attribute(std::string_view tag, std::string_view key) {
  const std::string opening = fmt::format(" {}=\"", key);
  const std::size_t from = tag.find(opening);
  if (from == std::string_view::npos) return std::nullopt;
  const std::size_t start = from + opening.size(), end = tag.find('"', start);
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(tag.substr(start, end - start));
}

}  // namespace

void PvdSeries::append(double time, const std::string& file) {
  if (file.find_first_of("<>&\"") != std::string::npos)
    throw std::invalid_argument(fmt::format("{}: file name \"{}\" holds characters that XML reserves", path_.string(), file));
  entries_.push_back({time, file});
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const PvdEntry& e : entries_)
    text += fmt::format("<DataSet timestep=\"{:.17g}\" group=\"\" part=\"0\" file=\"{}\"/>\n", e.time, e.file);
  text += "</Collection>\n</VTKFile>\n";
  try {
    write_file(path_, text);
  } catch (...) {
    entries_.pop_back();
    throw;
  }
}

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const auto damaged = [&](const char* what) { return std::runtime_error(fmt::format("{}: damaged file: {}", path.string(), what)); };
  if (text.find("</VTKFile>") == std::string::npos) throw damaged("it ends too early");
  std::vector<PvdEntry> entries;
  for (std::size_t at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1)) {
    const std::string_view tag = std::string_view(text).substr(at, text.find('>', at) - at);
    const auto time = attribute(tag, "timestep"), file = attribute(tag, "file");
    if (!time || !file) throw damaged("a DataSet has no timestep or no file");
    char* end = nullptr;
    const double value = std::strtod(time->c_str(), &end);
    if (end == time->c_str() || *end != '\0') throw damaged("a timestep is no number");
    entries.push_back({value, *file});
  }
  return entries;
}

}  // namespace crampon
