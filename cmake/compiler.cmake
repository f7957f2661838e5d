# One place for how the code is compiled; docs/decisions/0002-instruction-set.md says why.
set(CRAMPON_ISA "x86-64-v3" CACHE STRING "Instruction set of the kernels (-march value); empty: the compiler's baseline")
set(CRAMPON_SANITIZE "" CACHE STRING "address;undefined or thread")

add_library(crampon_flags INTERFACE)
# -Wrestrict of g++ 12 takes std::string assignments for overlapping copies (GCC bug 105329).
# Contraction off: geometric predicates and equal bits across compilers depend on it; kernels fuse explicitly (core/pack.hpp).
target_compile_options(crampon_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi -Wno-restrict -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Loops over rows of a few hundred bytes stay loops: g++ 12 makes "rep movs" of them, which takes longer to begin than the loop (step/assemble.hpp).
  target_compile_options(crampon_flags INTERFACE -fno-tree-loop-distribute-patterns)
endif()
if(CRAMPON_ISA AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(crampon_flags INTERFACE -march=${CRAMPON_ISA})
  target_compile_definitions(crampon_flags INTERFACE CRAMPON_ISA_NAME="${CRAMPON_ISA}")
endif()
if(CRAMPON_SANITIZE)
  string(REPLACE ";" "," _san "${CRAMPON_SANITIZE}")
  target_compile_options(crampon_flags INTERFACE -fsanitize=${_san} -fno-omit-frame-pointer -g)
  target_link_options(crampon_flags INTERFACE -fsanitize=${_san})
endif()
# With -O2 a step takes 20 to 100 % more instructions: g++ 12 then leaves the short loops over axes and nodes of a cell as loops.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
