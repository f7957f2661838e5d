#!/usr/bin/env python3
"""J and K_I of a central crack in a square plate under equal tension from all sides, at three resolutions, along the grid and oblique to it, with the tips in
many places within a cell. Prints a table for docs/verification.md; fails where the spread of K_I over places is over 3 % with 20 cells to the half length, and in proportion with others.

  fracture_convergence.py PROGRAM [--places 8] [--cells 5 10 20] [--shapes linear gimp bspline] [--angles 0 15 30 45] [--jobs 2]

The reference is a collocation of Muskhelishvili's potentials: exact on the crack, least squares of the tractions on the edges of the plate."""
import argparse
import concurrent.futures
import csv
import itertools
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy

HALF_WIDTH = 4  # of the plate, half lengths of the crack
E, NU, SIGMA = 1.0, 0.3, 1e-3
# Of the middle of the crack beside a node, in cells: vertices and tips on nodes, on lines of the grid, on rows of particles, and anywhere.
OFFSETS = [(0, 0), (0.25, 0), (0.5, 0), (0.75, 0), (0, 0.25), (0.25, 0.5), (0.5, 0.5), (0.6, 0.3)]
LARGEST_SPREAD = 0.03 * 20  # of K_I over places, largest less smallest over the mean, times cells to the half length

PLATE = """
analysis = "plane_strain"
[grid]
origin = [{low}, {low}]
size = [{size}, {size}]
cell = {h}
[time]
end = {end}
[method]
shape_functions = "{shape}"
damping = {damping}
[[material]]
name = "m"
law = "elastic_small_strain"
E = 1
nu = 0.3
density = 1
[[body]]
name = "plate"
material = "m"
shape = {{ kind = "rectangle", low = [-{w}, -{w}], high = [{w}, {w}] }}
initial_stress = {{ kind = "components", xx = 1e-3, yy = 1e-3, xy = 0 }}
[[crack]]
name = "c"
points = [[{x0}, {y0}], [{x1}, {y1}]]
{loads}
[fracture]
"""


def reference(degrees, terms=12, points=400):
    """K_I and K_II over sigma sqrt(pi a), for a = 1: in the frame of the crack, which lies along the real axis from -1 to 1."""
    turn = numpy.exp(-1j * math.radians(degrees))  # the plate in that frame
    s = (numpy.arange(points) + 0.5) / points * 2 - 1
    odd, even = 2 * numpy.arange(terms) + 1, 2 * numpy.arange(terms)
    rows, rhs = [], []
    for normal in (1, 1j, -1, -1j):
        z = HALF_WIDTH * (normal + s * normal * 1j) * turn
        n = normal * turn
        root = lambda x: numpy.sqrt(x - 1) * numpy.sqrt(x + 1)
        scale = 1 / (HALF_WIDTH * math.sqrt(2))
        columns = []
        # Phi = P/sqrt(z^2 - 1) + Q, Omega = P/sqrt(z^2 - 1) - Q; s_yy - i s_xy = Phi(z) + Omega(conj z) + (z - conj z) conj(Phi'(z)).
        for power, with_root in [(k, True) for k in odd] + [(k, False) for k in even]:
            for c in (1, 1j):
                def f(x):
                    p = c * (x * scale) ** power
                    return p / root(x) if with_root else p
                def df(x):
                    dp = c * power * (x * scale) ** (power - 1) * scale if power else 0 * x
                    return dp / root(x) - c * (x * scale) ** power * x / root(x) ** 3 if with_root else dp
                phi, omega = f(z), f(numpy.conj(z)) * (1 if with_root else -1)
                lower = phi + omega + (z - numpy.conj(z)) * numpy.conj(df(z))  # s_yy - i s_xy
                trace = 4 * phi.real
                yy, xy = lower.real, -lower.imag
                xx = trace - yy
                columns.append(numpy.concatenate([xx * n.real + xy * n.imag, xy * n.real + yy * n.imag]))
        rows.append(numpy.array(columns).T)
        rhs.append(numpy.concatenate([numpy.full(points, n.real), numpy.full(points, n.imag)]))
    a, *_ = numpy.linalg.lstsq(numpy.vstack(rows), numpy.concatenate(rhs), rcond=None)
    P = sum((a[2 * k] + 1j * a[2 * k + 1]) * scale ** power for k, power in enumerate(odd))
    K = 2 * P  # over sqrt(pi a): K_I - i K_II = 2 sqrt(pi/a) P(a)
    residual = numpy.abs(numpy.vstack(rows) @ a - numpy.concatenate(rhs)).max()
    return K.real, -K.imag, residual


def run(program, shape, cells, degrees, offset):
    h, w = 1 / cells, HALF_WIDTH
    c = math.sqrt(E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)))
    period = 4 * w / c
    x, y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    low = -(w + 3 * h)
    loads = "".join('[[load]]\nname = "%s"\nkind = "traction"\nface = "%s"\nvalue = [%g, %g]\n' % (name, face, SIGMA * i, SIGMA * j)
                    for name, face, i, j in (("right", "x+", 1, 0), ("left", "x-", -1, 0), ("top", "y+", 0, 1), ("bottom", "y-", 0, -1)))
    text = PLATE.format(low=low, size=-2 * low, h=h, end=3 * period, shape=shape, damping=2 * math.pi / period, w=w, loads=loads,
                        x0=offset[0] * h - x, y0=offset[1] * h - y, x1=offset[0] * h + x, y1=offset[1] * h + y)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "plate.toml"
        path.write_text(text)
        subprocess.run([program, "run", str(path), "--quiet", "--threads", "1", "--output", folder + "/out"], check=True,
                       stdout=subprocess.DEVNULL)
        with open(folder + "/out/history.csv") as f:
            reader = csv.reader(f)
            names = [name.split("[")[0] for name in next(reader)]
            last = list(reader)[-1]
    row = dict(zip(names, last))
    K = SIGMA * math.sqrt(math.pi)
    J = K * K * (1 - NU * NU) / E
    return [(float(row["K_I.c." + end]) / K, float(row["K_II.c." + end]) / K, float(row["J.c." + end]) / J) for end in ("start", "end")]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--cells", type=int, nargs="+", default=[5, 10, 20])
    options.add_argument("--shapes", nargs="+", default=["linear", "gimp", "bspline"])
    options.add_argument("--angles", type=float, nargs="+", default=[0, 15, 30, 45])
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--places", type=int, default=len(OFFSETS), help="how many places of the crack in its cell, at most %d" % len(OFFSETS))
    given = options.parse_args()
    print("| functions | angle | cells to the half length | K_I, mean over exact | spread of K_I | K_II over K_I | J, mean over exact | spread of J |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    failed = False
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for shape, degrees, cells in itertools.product(given.shapes, given.angles, given.cells):
            K_I, K_II, residual = reference(degrees)
            assert residual < 1e-3, "the reference does not meet the tractions on the edges: %g" % residual
            found = list(itertools.chain(*pool.map(lambda offset: run(given.program, shape, cells, degrees, offset), OFFSETS[:given.places])))
            I, II, J = (numpy.array([tip[k] for tip in found]) for k in range(3))
            exact = K_I ** 2 + K_II ** 2
            spread = numpy.ptp(I) / I.mean()
            print("| %s | %g | %d | %.4f | %.2f %% | %.4f | %.4f | %.2f %% |" % (
                shape, degrees, cells, I.mean() / K_I, 100 * spread, numpy.abs(II - K_II).max(), J.mean() / exact, 100 * numpy.ptp(J) / J.mean()), flush=True)
            if not spread <= LARGEST_SPREAD / cells:
                print("  the spread of K_I is over %g %%" % (100 * LARGEST_SPREAD / cells))
                failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
