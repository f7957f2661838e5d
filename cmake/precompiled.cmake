# Most files spend more than half of their time on headers: of the standard library, of fmt, of the state and the model of a run. These are compiled once: CRAMPON_PRECOMPILED for
# the program and the pictures, with CRAMPON_PRECOMPILED_STATE for the library, and with GoogleTest and the cases of tests for the tests. Nearly all files of the library and the
# tests include the headers of Crampon that stand here, and would be compiled again anyway when one of them changes.
# A target that reuses them must have the same options, and the definitions of the one that makes them. Files are whole without them: clang-tidy reads them so (cmake/check_tidy.sh).
set(CRAMPON_PRECOMPILED
  <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <span> <stdexcept> <string> <unordered_map> <utility>
  <variant> <vector> <fmt/format.h>)
set(CRAMPON_PRECOMPILED_STATE <crampon/state/state.hpp> <crampon/step/model.hpp> <crampon/step/step_work.hpp>)

# clang writes the time of each header into what it precompiles, so that a compiler cache would take none of it for the same.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Xclang -fno-pch-timestamp)
endif()
