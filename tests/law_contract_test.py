#!/usr/bin/env python3
"""Does the compiler name what a material law lacks, in its first error?

law_contract_test.py COMPILER
Compiles a law that is complete, and the same law without each of its members.
"""
import concurrent.futures
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "src"

# member: (its lines, words that the first error must hold when it is missing)
MEMBERS = {
    "name": ('static constexpr const char* name = "broken";', "static constexpr const char* name"),
    "declaration": ("static const Declaration<Law>& declaration();", "static const Declaration<Law>& declaration()"),
    "example": ("static Law example() { return {}; }", "static Law example()"),
    "density": ("double density = 0;", "double density"),
    "wave_speed": ("double wave_speed(StressState) const { return 1; }", "double wave_speed(StressState) const"),
    "wave_speed_changes": ("static constexpr bool wave_speed_changes = true;", "static constexpr bool wave_speed_changes"),
    "starts_with": ("static constexpr bool starts_with_deformation_gradient = false;", "static constexpr bool starts_with_deformation_gradient"),
    "history_size": ("template <int Dim> static constexpr int history_size = 1;", "static constexpr int history_size"),
    "variables": ('template <int Dim> static constexpr std::array<LawVariable, 1> variables{{{"heat", "J/m3", "heat", 0}}};',
                  "static constexpr std::array<LawVariable, N> variables"),
    "initialise": ("template <int Dim> static void initialise(Pack* history) { history[0] = splat(0.); }", "static void initialise(Pack* history)"),
    "update": ("template <int Dim, StressState S> Pack update(const Pack*, double, Pack*, Pack*) const { return splat(1.); }", "Pack update("),
    "report": ("template <int Dim, StressState S> PackReport report(const Pack*, const Pack*) const { PackReport r{}; return r; }", "PackReport report("),
    "present_wave_speed": ("template <int Dim, StressState S> Pack present_wave_speed(const Pack*, const Pack*) const { return splat(1.); }",
                           "Pack present_wave_speed("),
}
# What is there but wrong.
WRONG = {
    "a variable behind the history": ("variables", MEMBERS["variables"][0].replace(", 0}", ", 1}"), "each variable of a material law needs"),
    "a variable without a unit": ("variables", MEMBERS["variables"][0].replace("J/m3", ""), "each variable of a material law needs"),
    "an energy in another unit": ("variables", MEMBERS["variables"][0].replace("J/m3", "J").replace(", 0}", ", 0, 1, LawVariable::Kind::dissipated}"),
                                  "each variable of a material law needs"),
    "an update that returns nothing": ("update", "template <int Dim, StressState S> void update(const Pack*, double, Pack*, Pack*) const {}",
                                       "Pack update("),
}


def source(lines):
    return """#include <array>
#include "crampon/material/material.hpp"
namespace crampon {
struct Law {
  %s
};
void join(Family<MaterialSpec>& family) { add_material<Law>(family); }
}
""" % "\n  ".join(lines)


def first_error(compiler, lines):
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-w", "-I", str(SOURCE), "-x", "c++", "-"], input=source(lines), text=True,
                          capture_output=True)
    errors = [line for line in done.stderr.splitlines() if "error:" in line]
    return errors[0] if errors else ""


def check(compiler, what, lines, words):
    error = first_error(compiler, lines)
    good = words in error if words else not error
    return good, "%s: %s" % (what, error or "compiles")


def main(compiler):
    cases = [("a complete law", [text for text, _ in MEMBERS.values()], "")]
    for name, (_, words) in MEMBERS.items():
        cases.append(("without " + name, [text for other, (text, _) in MEMBERS.items() if other != name], words))
    for what, (name, text, words) in WRONG.items():
        cases.append((what, [text if other == name else kept for other, (kept, _) in MEMBERS.items()], words))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda case: check(compiler, *case), cases))
    for good, text in results:
        if not good:
            print(text)
    print("%d of %d as they should be" % (sum(good for good, _ in results), len(results)))
    return 0 if all(good for good, _ in results) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
