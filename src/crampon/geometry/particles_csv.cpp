#include "crampon/geometry/particles_csv.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "crampon/core/units.hpp"

namespace crampon {
namespace {

constexpr std::size_t most_diagnostics = 50;  // a wrong separator makes every line wrong; nobody reads a million messages

struct CsvCell {
  std::string_view text;  // without surrounding blanks
  int column;             // of its first character, from 1
};

struct Quantity {
  const char* name;
  const char* unit;
};
constexpr std::array<Quantity, 7> quantities{
    {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"volume", "m3"}, {"vx", "m/s"}, {"vy", "m/s"}, {"vz", "m/s"}}};
constexpr int volume_index = 3;

bool blank(char c) { return c == ' ' || c == '\t'; }

std::vector<CsvCell> split(std::string_view line) {
  std::vector<CsvCell> fields;
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    std::size_t from = start, to = end;
    while (from < to && blank(line[from])) ++from;
    while (to > from && blank(line[to - 1])) --to;
    fields.push_back({line.substr(from, to - from), static_cast<int>(from) + 1});
    if (end == line.size()) return fields;
    start = end + 1;
  }
}

// Units that are a power of ten smaller divide: the quotient of the nearest doubles is what the decimal shift means, 18 mm = 0.018 m.
struct Scale {
  double factor = 1, divisor = 1;
  double operator()(double value) const { return divisor != 1 ? value / divisor : factor != 1 ? value * factor : value; }
};

Scale scale_of(double factor) {
  for (double power = 10; power <= 1e21; power *= 10)
    if (std::abs(factor * power - 1) < 1e-14) return {1, power};
  return {factor, 1};
}

struct Column {
  int quantity = -1;  // index into `quantities`; -1: not understood
  Scale scale;
};

class Reader {
 public:
  Reader(std::string_view text, std::string file, int dimension) : text_(text), file_(std::move(file)), dimension_(dimension) {}

  ListedParticles read() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte order mark of some spreadsheets
    bool header_read = false;
    while (!text_.empty()) {
      const std::string_view line = next_line();
      if (std::all_of(line.begin(), line.end(), blank)) continue;
      if (!header_read) {
        read_header(line);
        header_read = true;
        if (!diagnostics_.empty()) break;  // rows mean nothing without their columns
      } else {
        read_row(line);
      }
    }
    if (!header_read)
      report(0, 0, "", "the file has no header line", "it is empty or all comments",
             fmt::format("start it with a line such as \"{}\"", example()));
    else if (diagnostics_.empty() && out_.particles.empty())
      report(0, 0, "", "the file has no particles", "a body needs at least one", "add a line for each particle below the header");
    if (suppressed_ > 0) report_always(0, 0, "", fmt::format("and {} more errors", suppressed_), "", "mend these first");
    if (!diagnostics_.empty()) throw InputError(std::move(diagnostics_));
    return std::move(out_);
  }

 private:
  std::string_view next_line() {
    ++line_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line.substr(0, line.find('#'));
  }

  std::string example() const { return dimension_ == 2 ? "x,y,volume" : "x,y,z,volume"; }
  bool needed(int quantity) const { return quantity == volume_index || quantity < dimension_; }
  bool allowed(int quantity) const { return dimension_ == 3 || (quantity != 2 && quantity != 6); }

  void read_header(std::string_view line) {
    std::array<bool, quantities.size()> seen{};
    for (const CsvCell& field : split(line)) {
      columns_.push_back(read_column(field));
      const int q = columns_.back().quantity;
      if (q < 0) continue;
      if (seen[q])
        report(line_, field.column, quantities[q].name, fmt::format("column {} appears twice", quantities[q].name),
               "it is not clear which one counts", "remove one of them");
      seen[q] = true;
    }
    const bool any_velocity = seen[4] || seen[5] || seen[6];
    for (int q = 0; q < static_cast<int>(quantities.size()); ++q) {
      if (seen[q] || !allowed(q) || !(needed(q) || any_velocity)) continue;
      report(line_, 1, "", fmt::format("column {} is missing", quantities[q].name),
             needed(q) ? fmt::format("particles in {}D need {}", dimension_, dimension_ == 2 ? "x, y and volume" : "x, y, z and volume")
                       : "velocity needs all of its components",
             fmt::format("add {} to the header and a value to every line", quantities[q].name));
    }
    out_.has_velocity = any_velocity;
  }

  Column read_column(const CsvCell& field) {
    std::string_view name = field.text;
    std::optional<std::string> unit;
    if (const std::size_t open = name.find('['); open != std::string_view::npos) {
      if (!name.ends_with(']')) {
        report(line_, field.column, "", fmt::format("\"{}\" has no closing bracket", name), "the unit does not end", "write name[unit]");
        return {};
      }
      unit = std::string(name.substr(open + 1, name.size() - open - 2));
      name = name.substr(0, open);
      while (!name.empty() && blank(name.back())) name.remove_suffix(1);
    }
    const auto found = std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& q) { return name == q.name; });
    const int index = static_cast<int>(found - quantities.begin());
    if (found == quantities.end() || !allowed(index)) {
      const std::string known = dimension_ == 2 ? "x, y, volume, vx, vy" : "x, y, z, volume, vx, vy, vz";
      report(line_, field.column, "", fmt::format("\"{}\" is not a column of a particle file", name),
             found == quantities.end() ? "its numbers would have no meaning" : "the problem is plane", "use " + known);
      return {};
    }
    Column column{index, {}};
    if (!unit) return column;
    try {
      column.scale = scale_of(unit_factor(*unit, found->unit));
    } catch (const UnitError& error) {
      report(line_, field.column, found->name, error.what, error.why, error.remedy);
    }
    return column;
  }

  void read_row(std::string_view line) {
    fields_ = split(line);
    if (fields_.size() != columns_.size()) {
      const bool blanks_only = fields_.size() == 1 && columns_.size() > 1;
      report(line_, fields_.size() > columns_.size() ? fields_[columns_.size()].column : static_cast<int>(line.size()) + 1, "",
             fmt::format("{} value{} where the header names {} column{}", fields_.size(), fields_.size() == 1 ? "" : "s", columns_.size(),
                         columns_.size() == 1 ? "" : "s"),
             "it is not clear which is which", blanks_only ? "separate values by commas" : "give one value for each column");
      return;
    }
    std::array<double, quantities.size()> values{};
    for (std::size_t k = 0; k < fields_.size(); ++k) values[columns_[k].quantity] = read_number(fields_[k], columns_[k]);
    out_.particles.push_back({{{values[0], values[1], values[2]}}, values[3], {{values[4], values[5], values[6]}}, line_});
  }

  double read_number(const CsvCell& field, const Column& column) {
    const char* name = quantities[column.quantity].name;
    std::string_view digits = field.text;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (field.text.empty()) {
      report(line_, field.column, name, "the value is missing", "every particle needs all columns", "write a number");
    } else if (code == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
      report(line_, field.column, name, fmt::format("{} does not fit a double", field.text), "numbers range from about 1e-308 to 1e308",
             "correct it or choose another unit");
    } else if (code != std::errc() || end != digits.data() + digits.size()) {
      report(line_, field.column, name, fmt::format("\"{}\" is not a number", field.text), "every value is a plain decimal number",
             "write it as 1.5 or 1.5e-3, with the unit in the header as name[unit]");
    } else if (!std::isfinite(value)) {
      report(line_, field.column, name, fmt::format("{} is not finite", field.text), "a particle has a place, a volume and a velocity",
             "write a finite number");
    } else if (column.quantity == volume_index && !(value > 0)) {
      report(line_, field.column, name, fmt::format("the volume is {}", value < 0 ? "negative" : "zero"),
             fmt::format("{} leaves the particle without mass", field.text), "give a volume above 0");
    }
    return column.scale(value);
  }

  void report(int line, int column, std::string where, std::string what, std::string why, std::string remedy) {
    if (diagnostics_.size() >= most_diagnostics)
      ++suppressed_;
    else
      report_always(line, column, std::move(where), std::move(what), std::move(why), std::move(remedy));
  }
  void report_always(int line, int column, std::string where, std::string what, std::string why, std::string remedy) {
    diagnostics_.push_back({{file_, line, column, std::move(where)}, std::move(what), std::move(why), std::move(remedy)});
  }

  std::string_view text_;
  std::string file_;
  int dimension_, line_ = 0;
  std::vector<Column> columns_;
  std::vector<CsvCell> fields_;
  ListedParticles out_;
  std::vector<Diagnostic> diagnostics_;
  std::size_t suppressed_ = 0;
};
}  // namespace

ListedParticles parse_particles_csv(const std::string& text, const std::string& file, int dimension) {
  return Reader(text, file, dimension).read();
}

ListedParticles read_particles_csv(const std::string& path, int dimension, const Location& named_at) {
  const auto fail = [&](std::string reason) {
    Location location = named_at;
    if (location.file.empty()) location.file = path;
    throw InputError({{location, fmt::format("cannot read the particle file \"{}\"", path), std::move(reason),
                       "correct the path (relative to the input file) or make the file"}});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("it is a folder");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(std::strerror(errno));
  std::ostringstream text;
  // An empty file sets failbit here, which is not an error of reading.
  text << in.rdbuf();
  if (in.bad() || text.bad()) fail("reading stopped half-way");
  return parse_particles_csv(text.str(), path, dimension);
}

}  // namespace crampon
