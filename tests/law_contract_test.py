#!/usr/bin/env python3
"""Does the compiler name what a law lacks, in its first error? For material, contact and traction laws, and for criteria of growth.

law_contract_test.py COMPILER
Compiles a law that is complete, and the same law without each of its members.
"""
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "src"
FLAGS = ["-std=c++20", "-w", "-I", str(SOURCE)]

# member: (its lines, words that the first error must hold when it is missing)
MATERIAL = {
    "name": ('static constexpr const char* name = "broken";', "static constexpr const char* name"),
    "strain_measure": ('static constexpr const char* strain_measure = "U - I";', "static constexpr const char* strain_measure"),
    "declaration": ("static const Declaration<Law>& declaration();", "static const Declaration<Law>& declaration()"),
    "example": ("static Law example() { return {}; }", "static Law example()"),
    "density": ("double density = 0;", "double density"),
    "elasticity": ("std::optional<ElasticConstants> elasticity() const { return {}; }", "ElasticConstants elasticity() const"),
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
MATERIAL_WRONG = {
    "a variable behind the history": ("variables", MATERIAL["variables"][0].replace(", 0}", ", 1}"), "each variable of a material law needs"),
    "a variable without a unit": ("variables", MATERIAL["variables"][0].replace("J/m3", ""), "each variable of a material law needs"),
    "an energy in another unit": ("variables", MATERIAL["variables"][0].replace("J/m3", "J").replace(", 0}", ", 0, 1, LawVariable::Kind::dissipated}"),
                                  "each variable of a material law needs"),
    "an update that returns nothing": ("update", "template <int Dim, StressState S> void update(const Pack*, double, Pack*, Pack*) const {}",
                                       "Pack update("),
}


CONTACT = {
    "name": ('static constexpr const char* name = "broken";', "static constexpr const char* name"),
    "declaration": ("static const Declaration<Law>& declaration();", "static const Declaration<Law>& declaration()"),
    "examples": ("static std::vector<Law> examples() { return {}; }", "static std::vector<Law> examples()"),
    "meeting": ("static constexpr Meeting meeting = Meeting::pressing;", "static constexpr Meeting meeting"),
    "adheres": ("static constexpr bool adheres = true;", "static constexpr bool adheres"),
    "needs_area": ("bool needs_area() const { return true; }", "bool needs_area() const"),
    "remembers": ("Remembered remembers() const { return Remembered::nothing; }", "Remembered remembers() const"),
    "limit": ("SlidingLimit limit(const Sliding&) const { return {}; }", "SlidingLimit limit(const Sliding&) const"),
    "strictness": ("Strictness strictness() const { return {}; }", "Strictness strictness() const"),
    "holds": ("bool holds(const Pull&) const { return true; }", "bool holds(const Pull&) const"),
}
CONTACT_WRONG = {
    "springs that are not given": ("meeting", "static constexpr Meeting meeting = Meeting::springs;", "ContactSprings springs() const"),
    "joined faces that adhere": ("meeting", "static constexpr Meeting meeting = Meeting::joined;", "only a contact law whose meeting is Meeting::pressing"),
    "an area that is needed by all": ("needs_area", "static constexpr bool needs_area = true;", "bool needs_area() const"),
    "a limit that is a number": ("limit", "double limit(const Sliding&) const { return 0; }", "SlidingLimit limit(const Sliding&) const"),
}
TRACTION = {
    "name": ('static constexpr const char* name = "broken";', "static constexpr const char* name"),
    "Input": ("using Input = Law;", "using Input"),
    "declaration": ("static const Declaration<Law>& declaration();", "static const Declaration<Input>& declaration()"),
    "make": ("static Law make(const Law& in) { return in; }", "static Law make(const Input&)"),
    "examples": ("static std::vector<Law> examples() { return {}; }", "static std::vector<Law> examples()"),
    "acts": ("static constexpr bool acts = true;", "static constexpr bool acts ="),
    "acts_closed": ("static constexpr bool acts_closed = false;", "static constexpr bool acts_closed"),
    "from_outside": ("static constexpr bool from_outside = false;", "static constexpr bool from_outside"),
    "respond": ("Traction respond(const PerMode&, double, const Vec<3>&, TractionHistory&) const { return {}; }", "Traction respond("),
    "largest_stiffness": ("double largest_stiffness() const { return 0; }", "double largest_stiffness() const"),
    "toughness": ("PerMode toughness() const { return {}; }", "PerMode toughness() const"),
}
TRACTION_WRONG = {
    "a toughness for both modes": ("toughness", "double toughness() const { return 0; }", "PerMode toughness() const"),
}
CRITERION = {
    "name": ('static constexpr const char* name = "broken";', "static constexpr const char* name"),
    "declaration": ("static const Declaration<Law>& declaration();", "static const Declaration<Criterion>& declaration()"),
    "examples": ("static std::vector<Law> examples() { return {}; }", "a criterion needs"),
    "drive": ("double drive(const TipState&) const { return 0; }", "double drive(const TipState&) const"),
    "angle": ("double angle(const TipState&) const { return 0; }", "double angle(const TipState&) const"),
    "speed": ("double speed(const TipState&) const { return 1; }", "double speed(const TipState&) const"),
    "needs_intensities": ("static constexpr bool needs_intensities = false;", "static constexpr bool needs_intensities"),
    "looks_ahead": ("static constexpr bool looks_ahead = false;", "static constexpr bool looks_ahead"),
}
CRITERION_WRONG = {
    "a direction in place of an angle": ("angle", "Vec<2> angle(const TipState&) const { return {}; }", "double angle(const TipState&) const"),
}
# (family, header, how a law joins, members, what is wrong)
FAMILIES = (
    ("material", "material/material.hpp", "void join(Family<MaterialSpec>& family) { add_material<Law>(family); }", MATERIAL, MATERIAL_WRONG),
    ("contact", "contact/law.hpp", "void join(Family<ContactLawSpec>& family) { add_contact_law<Law>(family); }", CONTACT, CONTACT_WRONG),
    ("traction", "crack/traction/law.hpp", "void join(Family<TractionLawSpec>& family) { add_traction_law<Law>(family); }", TRACTION, TRACTION_WRONG),
    ("criterion", "crack/criteria/criterion.hpp", "void join(Family<GrowthCriterionSpec>& family) { add_growth_criterion<Law>(family); }",
     CRITERION, CRITERION_WRONG),
)


def source(join, lines):
    return """namespace crampon {
struct Law {
  %s
};
%s
}
""" % ("\n  ".join(lines), join)


def precompile(compiler, folder, header):
    """What all laws of a family include, compiled once. Returns the file to include first."""
    first = pathlib.Path(folder) / header.replace("/", "_")
    first.write_text('#include <array>\n#include "crampon/%s"\n' % header)
    subprocess.run([compiler, *FLAGS, "-x", "c++-header", str(first), "-o", "%s.gch" % first], check=True)
    return first


def first_error(compiler, first, code):
    done = subprocess.run([compiler, *FLAGS, "-fsyntax-only", "-include", str(first), "-x", "c++", "-"], input=code, text=True, capture_output=True)
    errors = [line for line in done.stderr.splitlines() if "error:" in line]
    return errors[0] if errors else ""


def check(compiler, what, first, code, words):
    error = first_error(compiler, first, code)
    good = words in error if words else not error
    return good, "%s: %s" % (what, error or "compiles")


def main(compiler):
    with tempfile.TemporaryDirectory() as folder:
        cases = []
        for family, header, join, members, wrong in FAMILIES:
            first = precompile(compiler, folder, header)

            def add(what, lines, words):
                cases.append(("%s law, %s" % (family, what), first, source(join, lines), words))
            add("complete", [text for text, _ in members.values()], "")
            for name, (_, words) in members.items():
                add("without " + name, [text for other, (text, _) in members.items() if other != name], words)
            for what, (name, text, words) in wrong.items():
                add(what, [text if other == name else kept for other, (kept, _) in members.items()], words)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda case: check(compiler, *case), cases))
    for good, text in results:
        if not good:
            print(text)
    print("%d of %d as they should be" % (sum(good for good, _ in results), len(results)))
    return 0 if all(good for good, _ in results) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
