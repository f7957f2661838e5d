#pragma once
/// "Did you mean" for names in results: history columns, quantities.

#include <string>
#include <string_view>
#include <vector>

namespace crampon {

/// "; did you mean \"x\"?" for the name most like the unknown one, or "; there are: a, b, c" when none is alike. Empty without names.
std::string suggest_name(std::string_view unknown, const std::vector<std::string>& names);

}  // namespace crampon
