#pragma once
/// The starter inputs of `crampon init`: the files of templates/, compiled into the program.

#include <string_view>
#include <vector>

namespace crampon::app {

struct Template {
  std::string_view name;
  std::string_view text;
};

/// In alphabetical order.
const std::vector<Template>& templates();

}  // namespace crampon::app
