#include <unistd.h>

#include <cstring>

#ifndef CRAMPON_ISA_NAME
#define CRAMPON_ISA_NAME ""
#endif

namespace {

/// A processor without the instructions that the kernels were compiled for would end the program with "Illegal instruction". This file
/// is compiled for any x86-64 and runs before every other initialisation, so that the user reads what to do instead.
[[gnu::constructor(101)]] void check_processor() {
#ifdef __x86_64__
  if (std::strcmp(CRAMPON_ISA_NAME, "x86-64-v3") != 0) return;  // another choice was made by whoever built the program
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) return;
  constexpr char message[] =
      "crampon: this program was built for processors with AVX2 and FMA (x86-64-v3), which this one is not; build it with "
      "cmake --preset release -DCRAMPON_ISA=x86-64\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
  ::_exit(4);
#endif
}

}  // namespace
