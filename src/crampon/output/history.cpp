#include "crampon/output/history.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "crampon/core/closest_name.hpp"
#include "crampon/core/formula.hpp"
#include "crampon/output/file.hpp"

namespace crampon {

HistoryWriter::HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns)
    : path_(std::move(path)), columns_(columns.size()) {
  std::string header;
  for (const HistoryColumn& c : columns) {
    if (c.name.find_first_of(",[]\"\n\r") != std::string::npos || c.unit.find_first_of(",[]\"\n\r") != std::string::npos)
      throw std::invalid_argument(fmt::format("history column \"{}[{}]\" holds a character that the header reserves", c.name, c.unit));
    header += fmt::format("{}{}[{}]", header.empty() ? "" : ",", c.name, c.unit);
  }
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) throw std::runtime_error(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
  try {
    write_line(header + "\n");
  } catch (...) {
    ::close(file_);
    throw;
  }
}

HistoryWriter::~HistoryWriter() { ::close(file_); }

void HistoryWriter::write_row(const std::vector<double>& row) {
  if (row.size() != columns_)
    throw std::invalid_argument(fmt::format("{}: a row of {} values for {} columns", path_.string(), row.size(), columns_));
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (k > 0) line += ',';
    line += fmt::format("{:.17g}", row[k]);
  }
  write_line(line + "\n");
}

void HistoryWriter::write_line(const std::string& line) {
  const off_t before = ::lseek(file_, 0, SEEK_CUR);
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t n = ::write(file_, line.data() + done, line.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int code = errno;
      // A pipe or device cannot be cut back; there the row begun stays without its end, which the reader leaves out.
      if (before >= 0 && ::ftruncate(file_, before) == 0) ::lseek(file_, before, SEEK_SET);
      throw std::runtime_error(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(code)));
    }
    done += static_cast<std::size_t>(n);
  }
}

namespace {

/// "J" of "J.notch.end".
std::string_view part_before_dot(std::string_view name) { return name.substr(0, name.find('.')); }

/// That there is no such column, and which is meant or what there is: the columns of the same quantity where there are some.
std::string no_column(const History& history, const std::string& name) {
  std::vector<std::string> all, near, same_quantity;
  for (const HistoryColumn& c : history.columns) {
    const bool is_same = part_before_dot(c.name) == part_before_dot(name);
    if (is_same) same_quantity.push_back(c.name);
    if (!is_same && name.find('.') == std::string::npos) near.emplace_back(part_before_dot(c.name));
    near.push_back(c.name);
    all.push_back(c.name);
  }
  const auto closest = closest_name(name, near);
  const std::string advice =
      closest ? fmt::format("did you mean \"{}\"?", *closest) : suggest_from(name, same_quantity.empty() ? all : same_quantity);
  return fmt::format("the history has no column \"{}\"; {}", name, advice);
}

/// Puts another word for a name where this stands by itself in a formula.
void replace_word(std::string& formula, const std::string& name, const std::string& word) {
  const auto goes_on = [&](std::size_t k) {
    if (k >= formula.size()) return false;
    const char c = formula[k];
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  };
  if (name.empty()) return;
  for (std::size_t at = formula.find(name); at != std::string::npos; at = formula.find(name, at + 1)) {
    if ((at > 0 && goes_on(at - 1)) || goes_on(at + name.size())) continue;
    formula.replace(at, name.size(), word);
  }
}

}  // namespace

bool History::has_column(std::string_view name) const {
  return std::any_of(columns.begin(), columns.end(), [&](const HistoryColumn& c) { return c.name == name; });
}

std::size_t History::column_index(std::string_view name) const {
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].name == name) return k;
  throw std::out_of_range(no_column(*this, std::string(name)));
}

std::vector<std::string> History::columns_of(const std::string& name) const {
  if (has_column(name)) return {name};
  std::vector<std::string> all;
  for (const HistoryColumn& c : columns)
    if (part_before_dot(c.name) == name) all.push_back(c.name);
  if (all.empty()) throw std::out_of_range(no_column(*this, name));
  return all;
}

namespace {

double interpolate(const std::vector<double>& t, const std::vector<double>& y, double time) {
  if (t.empty()) throw std::out_of_range("the history has no rows");
  const double slack = 1e-9 * (t.back() - t.front());  // an end time printed and read again
  if (!(time >= t.front() - slack && time <= t.back() + slack))
    throw std::out_of_range(fmt::format("time {:g} s lies outside the history, which covers {:g} s to {:g} s", time, t.front(), t.back()));
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return y.front();
  if (after == t.end()) return y.back();
  const std::size_t k = static_cast<std::size_t>(after - t.begin()) - 1;
  if (t[k] == time) return y[k];
  const double w = (time - t[k]) / (t[k + 1] - t[k]);
  return (1 - w) * y[k] + w * y[k + 1];
}

}  // namespace

double History::value_at(std::string_view name, double time) const {
  const std::vector<double>& y = column(name);  // throws first when there is no column at all
  return interpolate(values[0], y, time);
}

HistoryStatistics History::statistics(std::string_view name, double from, double to) const {
  if (!(from <= to)) throw std::invalid_argument(fmt::format("range from {:g} s to {:g} s runs backwards", from, to));
  const std::vector<double>& y = column(name);
  const std::vector<double>& t = values[0];
  std::vector<double> times{from}, curve{interpolate(t, y, from)};
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] <= from || t[k] >= to) continue;
    times.push_back(t[k]);
    curve.push_back(y[k]);
  }
  times.push_back(to);
  curve.push_back(interpolate(t, y, to));

  HistoryStatistics s;
  s.minimum = *std::min_element(curve.begin(), curve.end());
  s.maximum = *std::max_element(curve.begin(), curve.end());
  double area = 0;
  for (std::size_t k = 1; k < times.size(); ++k) area += 0.5 * (curve[k] + curve[k - 1]) * (times[k] - times[k - 1]);
  s.mean = to > from ? area / (to - from) : curve.front();
  s.spread = s.maximum - s.minimum;
  // min_element passes over NaN; a range with one has no extremes.
  if (std::any_of(curve.begin(), curve.end(), [](double v) { return v != v; })) s.minimum = s.maximum = s.spread = s.mean;
  return s;
}

void History::add_column(const HistoryColumn& column, const std::string& formula) {
  if (has_column(column.name))
    throw std::invalid_argument(fmt::format("the history has a column \"{}\"; give the new one another name", column.name));
  // A crack may be called "left-most", which no formula can hold: its columns go by other words there, those of long names first.
  std::vector<std::string> names;
  std::vector<std::size_t> others;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!is_formula_name(columns[k].name)) others.push_back(k);
    names.push_back(is_formula_name(columns[k].name) ? columns[k].name : fmt::format("_column{}", k));
  }
  std::stable_sort(others.begin(), others.end(),
                   [&](std::size_t a, std::size_t b) { return columns[a].name.size() > columns[b].name.size(); });
  std::string spelt = formula;
  for (const std::size_t k : others) replace_word(spelt, columns[k].name, names[k]);
  try {
    Formula evaluate(spelt, names);
    std::vector<double> row(names.size()), result(rows());
    for (std::size_t i = 0; i < rows(); ++i) {
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = values[k][i];
      result[i] = evaluate(row);
    }
    columns.push_back(column);
    values.push_back(std::move(result));
  } catch (const UnknownVariable& unknown) {
    throw std::invalid_argument(fmt::format("{}: {}", column.name, no_column(*this, unknown.name)));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", column.name, error.what()));
  }
}

History read_history(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  History history;
  std::size_t line_number = 0, at = 0;
  const auto fail = [&](const std::string& what) {
    return std::runtime_error(fmt::format("{}:{}: {}", path.string(), std::max<std::size_t>(line_number, 1), what));
  };
  for (std::size_t end = text.find('\n'); end != std::string::npos; at = end + 1, end = text.find('\n', at)) {
    ++line_number;
    std::string line = text.substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::size_t column = 0, from = 0;
    for (bool more = true; more; ++column) {
      const std::size_t comma = line.find(',', from);
      more = comma != std::string::npos;
      const std::string cell = line.substr(from, more ? comma - from : comma);
      from = comma + 1;
      if (line_number == 1) {
        const std::size_t bracket = cell.find('[');
        if (bracket == std::string::npos || cell.back() != ']') throw fail(fmt::format("column \"{}\" is not name[unit]", cell));
        history.columns.push_back({cell.substr(0, bracket), cell.substr(bracket + 1, cell.size() - bracket - 2)});
        history.values.emplace_back();
        continue;
      }
      if (column >= history.columns.size()) throw fail("more values than columns");
      char* stop = nullptr;
      const double value = std::strtod(cell.c_str(), &stop);
      if (stop == cell.c_str() || *stop != '\0') throw fail(fmt::format("\"{}\" is no number", cell));
      history.values[column].push_back(value);
    }
    if (line_number > 1 && column != history.columns.size()) throw fail("fewer values than columns");
  }
  if (history.columns.empty()) throw fail("no header");
  return history;
}

}  // namespace crampon
