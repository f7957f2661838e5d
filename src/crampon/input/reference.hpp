#pragma once
/// The input's declaration as a page of documentation: docs/reference/input.md.

#include <string>

#include "crampon/core/record.hpp"

namespace crampon {

/// Markdown; every key with type, unit, default, bounds and help, and the families with their alternatives.
std::string reference_page();
/// The same for any record.
std::string reference_page(const Record& root);

}  // namespace crampon
