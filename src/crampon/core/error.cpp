#include "crampon/core/error.hpp"

#include <utility>

namespace crampon {

std::string Diagnostic::text() const {
  std::string out;
  if (!location.file.empty()) {
    out += location.file;
    if (location.line > 0) out += ":" + std::to_string(location.line) + ":" + std::to_string(location.column);
    out += ": ";
  }
  if (!location.where.empty()) out += location.where + ": ";
  out += what;
  if (!why.empty()) out += " (" + why + ")";
  if (!remedy.empty()) out += "; " + remedy;
  return out;
}

namespace {
std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string out;
  for (const Diagnostic& d : diagnostics) out += (out.empty() ? "" : "\n") + d.text();
  return out;
}
}  // namespace

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace crampon
