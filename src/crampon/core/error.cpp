#include "crampon/core/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace crampon {

std::string Diagnostic::text() const {
  std::string out;
  if (!location.file.empty()) {
    out += location.file;
    if (location.line > 0) out += fmt::format(":{}:{}", location.line, location.column);
    out += ": ";
  }
  if (!location.where.empty()) out += location.where + ": ";
  out += what;
  if (!why.empty()) out += fmt::format(" ({})", why);
  if (!remedy.empty()) out += fmt::format("; {}", remedy);
  return out;
}

namespace {
std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string out;
  for (const Diagnostic& d : diagnostics) {
    if (!out.empty()) out += '\n';
    out += d.text();
  }
  return out;
}
}  // namespace

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace crampon
