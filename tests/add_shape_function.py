#!/usr/bin/env python3
"""Puts the shape function of tests/toy_shape.hpp among the others: one file, one include and one line in a copy of shape/registry.hpp.

    add_shape_function.py write FOLDER      writes both into a folder of includes that hides the list (tests/unit/toy_shape_test.cpp)
    add_shape_function.py members COMPILER  shows that without any one of its members the list does not compile, and that the first error names
                                            it; so with members that do not fit each other
"""
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parent.parent
FLAGS = ["-std=c++20", "-mavx2", "-mfma", "-Wno-psabi", "-I", str(TOP / "src")]
REGISTRY = (TOP / "src" / "crampon" / "shape" / "registry.hpp").read_text()
TOY = (TOP / "tests" / "toy_shape.hpp").read_text()
MEMBERS = ["name", "help", "width", "below", "bin_shift", "has_domains", "boxes", "uneven_edge", "reach", "weights"]
# What is changed, into what, and a part of the sentence that the first error must have.
MISFITS = [
    ("int below = 1", "int below = 0", "reaches a node below its stencil"),
    ("int width = 4", "int width = 3", "reaches a node above its stencil"),
    ("double bin_shift = 0", "double bin_shift = 0.5", "reaches a node below its stencil"),
    (".cell = 3", ".cell = 2", "is not that of its `boxes`"),
    ("1.5 + half_size", "2 + half_size", "reaches"),
]


def without(member):
    """The toy less one member: a declaration of one line, or the function that ends with the struct."""
    if member == "weights":
        changed = re.sub(r"\n  static void weights.*\n  }\n};", "\n};", TOY, flags=re.S)
    else:
        changed = re.sub(r"\n  static constexpr [^\n]*\b%s\b *[=({][^\n]*" % member, "", TOY, count=1)
    assert changed != TOY, member
    return changed


def write_overlay(folder, toy):
    shape = pathlib.Path(folder, "crampon", "shape")
    shape.mkdir(parents=True, exist_ok=True)
    (shape / "toy.hpp").write_text(toy)
    longer = REGISTRY.replace('#include "crampon/shape/linear.hpp"\n', '#include "crampon/shape/linear.hpp"\n#include "crampon/shape/toy.hpp"\n', 1)
    longer, lines = re.subn(r"(#define CRAMPON_SHAPES.*?[^\\])\n", r"\1 \\\n  X(ToyShape, MORE)\n", longer, count=1, flags=re.S)
    assert longer.count("toy.hpp") == 1 and lines == 1, "the list in shape/registry.hpp does not look as this test expects"
    (shape / "registry.hpp").write_text(longer)


def precompile(compiler, folder):
    """What the list includes, compiled once. Returns the file to include first."""
    first = pathlib.Path(folder, "before_the_list.hpp")
    first.write_text("#include <stdexcept>\n#include <utility>\n" + "".join(
        line + "\n" for line in REGISTRY.splitlines() if line.startswith('#include "crampon/shape/')))
    subprocess.run([compiler, *FLAGS, "-x", "c++-header", str(first), "-o", "%s.gch" % first], check=True)
    return first


def first_error(compiler, first, toy):
    with tempfile.TemporaryDirectory() as folder:
        write_overlay(folder, toy)
        done = subprocess.run([compiler, "-I", folder, *FLAGS, "-fsyntax-only", "-include", str(first), "-x", "c++", "-"],
                              input='#include "crampon/shape/registry.hpp"\n', capture_output=True, text=True)
    errors = [line for line in done.stderr.splitlines() if re.search(r"\berror:", line)]
    return errors[0] if errors else ""


def test_members(compiler):
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        first = precompile(compiler, folder)
        whole = first_error(compiler, first, TOY)
        if whole:
            failures.append("the whole toy does not compile: " + whole)
        for member in MEMBERS:
            error = first_error(compiler, first, without(member))
            print("without %s: %s" % (member, error or "compiles"))
            if "a shape function lacks `%s" % member not in error:
                failures.append("without %s the first error is: %s" % (member, error or "none"))
        for old, new, expected in MISFITS:
            assert old in TOY, old
            error = first_error(compiler, first, TOY.replace(old, new, 1))
            print("with %s: %s" % (new, error or "compiles"))
            if expected not in error:
                failures.append("with %s the first error is: %s" % (new, error or "none"))
    return failures


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "members":
        failures = test_members(sys.argv[2])
    elif len(sys.argv) == 3 and sys.argv[1] == "write":
        write_overlay(sys.argv[2], TOY)
        failures = []
    else:
        sys.exit(__doc__)
    for failure in failures:
        print("FAILED:", failure, file=sys.stderr)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
