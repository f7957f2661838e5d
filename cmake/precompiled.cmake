# Most files spend a third of their time on headers of the standard library and of fmt. These are compiled once, and GoogleTest for the tests.
# Headers of Crampon are not among them: every change of one would compile all files again.
# A target that reuses them must have the same options, and the definitions of the one that makes them. Files are whole without them: clang-tidy reads them so (cmake/check_tidy.sh).
set(CRAMPON_PRECOMPILED
  <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <span> <stdexcept> <string> <unordered_map> <utility>
  <variant> <vector> <fmt/format.h>)

# clang writes the time of each header into what it precompiles, so that a compiler cache would take none of it for the same.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Xclang -fno-pch-timestamp)
endif()
