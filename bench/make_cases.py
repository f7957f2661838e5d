#!/usr/bin/env python3
"""Writes the benchmark inputs bench/cases/*.toml: bench/make_cases.py [--check].

An elastic block that shakes gently, one metre to a cell: 4 particles per cell in 2D, 8 in 3D. Variants in 2D: a crack of half the width, twenty of
a tenth each, one along the diagonal, and two materials that touch along a line. Of linear USF also a block of four million particles, one whose
particles have left their lattice after some dozens of steps, and one in a grid a hundred times its size.
"""
import math
import pathlib
import sys

CASES = pathlib.Path(__file__).parent / "cases"
SIZES = ("65k", "400k", "1m")
CELLS = {2: {"9k": 48, "65k": 128, "400k": 316, "1m": 500, "4m": 1000}, 3: {"9k": 10, "65k": 20, "400k": 37, "1m": 50}}  # along each side
STEPS = {"9k": 1000, "65k": 400, "400k": 100, "1m": 40, "4m": 10}
MARGIN = 3  # empty cells around the block

MATERIAL = """
[[material]]
name = "{0}"
law = "elastic_small_strain"
E = {1:g}
nu = 0.33
density = 1.5
"""


def crack(x0, y0, x1, y1):
    return ('\n[[crack]]\npoints = [[%g, %g], [%g, %g]]\ncontact = { law = "coulomb", friction = 0.3 }\n' % (x0, y0, x1, y1))


def cracks(variant, n):
    """In multiples of a cell, off the grid lines; ends lie inside the block."""
    at = lambda fraction: MARGIN + fraction * n
    if variant == "crack":
        return crack(at(0.25), at(0.5) + 0.3, at(0.75), at(0.5) + 0.31)
    if variant == "diagonal":
        return crack(at(0.2), at(0.2) + 0.3, at(0.8), at(0.8) + 0.3)
    if variant == "cracks20":
        return "".join(crack(at(0.05 + 0.24 * column), at(0.1 + 0.2 * row) + 0.3, at(0.15 + 0.24 * column), at(0.1 + 0.2 * row) + 0.31)
                       for row in range(5) for column in range(4))
    return ""


SHAKING = ("0.01*sin(0.01*x)", "0.01*cos(0.013*y)")
SHEARING = {2: ("0.01*sin(0.15*y)", "0.004"), 3: ("0.01*sin(0.15*y + 0.1*z)", "0.004", "0.003")}  # hardly resisted, up to a tenth of a cell per step


def body(name, material, low, high, dim, motion=SHAKING):
    velocity = (['{ expression = "%s" }' % component for component in motion] + ["0"])[:dim]
    vector = lambda v: "[" + ", ".join("%g" % c for c in v) + "]"
    return ('\n[[body]]\nname = "%s"\nmaterial = "%s"\nshape = { kind = "%s", low = %s, high = %s }\nvelocity = [%s]\n'
            % (name, material, "rectangle" if dim == 2 else "box", vector(low), vector(high), ", ".join(velocity)))


def case(dim, shape, update, size, variant):
    n = CELLS[dim][size]
    margin = 40 if variant == "drifted" else MARGIN
    side = n + 2 * margin if variant != "sparse" else math.ceil(n * 100 ** (1 / dim))
    vector = lambda c: "[" + ", ".join([str(c)] * dim) + "]"
    text = '# Written by bench/make_cases.py.\nanalysis = "%s"\n' % ("plane_strain" if dim == 2 else "three_dimensional")
    text += "\n[grid]\norigin = %s\nsize = %s\ncell = 1\n" % (vector(0), vector(side))
    text += "\n[time]\nsteps = %d\n%s\n" % (STEPS[size], "step = 10" if variant == "drifted" else "courant = 0.2")
    text += '\n[method]\nshape_functions = "%s"\nstress_update = "%s"\n' % (shape, update)
    low, high = [margin] * dim, [margin + n] * dim
    if variant == "contact":
        text += '\n[contact]\nfields = "materials"\ndefault = { law = "coulomb", friction = 0.3 }\n'
        text += MATERIAL.format("elastic", 100) + MATERIAL.format("other", 100)
        half = MARGIN + n // 2
        text += body("lower", "elastic", low, [high[0], half], dim) + body("upper", "other", [low[0], half], high, dim)
    elif variant == "drifted":
        text += MATERIAL.format("elastic", 1e-6) + body("block", "elastic", low, high, dim, SHEARING[dim])
    else:
        text += MATERIAL.format("elastic", 100) + body("block", "elastic", low, high, dim) + cracks(variant, n)
    return text + "\n[output]\nevery_steps = %d\nhistory_steps = %d\n" % (STEPS[size], STEPS[size])


def all_cases():
    for dim in (2, 3):
        for shape in ("linear", "gimp", "bspline"):
            for update in ("usf", "musl", "usavg"):
                for size in SIZES:
                    for variant in ("", "crack", "cracks20", "diagonal", "contact") if dim == 2 else ("",):
                        name = "block%dd-%s-%s-%s%s.toml" % (dim, shape, update, size, variant and "-" + variant)
                        yield name, case(dim, shape, update, size, variant)
        for size, variant in (("400k", "drifted"), ("65k", "sparse")):
            yield "block%dd-linear-usf-%s-%s.toml" % (dim, size, variant), case(dim, "linear", "usf", size, variant)
    yield "block2d-linear-usf-4m.toml", case(2, "linear", "usf", "4m", "")


def main():
    wanted = dict(all_cases())
    if sys.argv[1:] == ["--check"]:
        there = {path.name: path.read_text() for path in CASES.glob("*.toml")}
        stale = sorted(name for name in wanted.keys() | there.keys() if wanted.get(name) != there.get(name))
        if stale:
            sys.exit("bench/cases is stale (%s ...); mend it with: bench/make_cases.py" % stale[0])
        return
    CASES.mkdir(exist_ok=True)
    for path in CASES.glob("*.toml"):
        path.unlink()
    for name, text in wanted.items():
        (CASES / name).write_text(text)


if __name__ == "__main__":
    main()
