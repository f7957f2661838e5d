#!/usr/bin/env python3
"""Runs the engine and the oracle on the same cases and compares every particle and crack vertex at every step.

compare.py PROGRAM [--case TEXT ...] [--share N] [--folder DIR] [--list]

Differences are given relative to the largest value of the field in the whole run. Tolerance 1e-9: both sides add the same
numbers in another order, some 1e-16 a step, and 60 steps of wave propagation and contact do not amplify that a million times.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import traceback

import numpy as np

import cramp
from crack_motion import present_crack
from emit import emit
from option_cases import all_cases
from vtk_read import read_series, read_vtp

TOLERANCE = 1e-9


def oracle_frames(case):
    """Fields of every step, the start included: {name: array steps x items x components}."""
    model = cramp.Model(case)
    frames = []

    def keep():
        particles = model.particles
        x = [p.present(model.lead) for p in particles]
        cracks = [present_crack(model, crack) for crack in model.cracks]
        stress = [p.material.stress() for p in particles]
        frame = {"position": x, "velocity": [list(p.v) for p in particles],
                 "displacement": [[now[k] - p.X[k] for k in range(2)] for now, p in zip(x, particles)],
                 "stress": [[s[0], s[1], s[2], s[3]] for s in stress]}
        if all(hasattr(p.material, "alpha") for p in particles):
            frame["plastic_strain"] = [[p.material.alpha] for p in particles]
        for name in ("plane", "upper", "lower"):
            points = [(x[0] - X[0], x[1] - X[1]) for crack in cracks for x, X in zip(getattr(crack, name), crack.original)]
            if points:
                frame["crack " + name] = points
        frames.append(frame)

    keep()
    for _ in range(case["steps"]):
        model.step()
        keep()
    return {name: np.array([f[name] for f in frames], float) for name in frames[0]}


def engine_frames(case, program, folder):
    source = emit(case, folder)
    results = os.path.join(folder, case["name"] + "_results")
    done = subprocess.run([program, "run", source, "--output", results, "--force", "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError("%s run gave %d: %s" % (program, done.returncode, (done.stderr or done.stdout).strip()[-2000:]))
    frames = []
    for _, file in read_series(os.path.join(results, "particles.pvd")):
        data = read_vtp(file)
        points, fields = data["Points"], data["PointData"]
        frames.append({"position": next(iter(points.values()))[:, :2], "velocity": fields["velocity"][:, :2],
                       "displacement": fields["displacement"][:, :2], "stress": fields["stress"][:, :4]})
        if "plastic_strain" in fields:
            frames[-1]["plastic_strain"] = np.reshape(fields["plastic_strain"], (-1, 1))
    if case.get("cracks"):
        original = np.array([v for crack in case["cracks"] for v in crack["points"]], float)
        series = read_series(os.path.join(results, "cracks.pvd"))
        if len(series) != len(frames):
            raise RuntimeError("%d frames of cracks, %d of particles" % (len(series), len(frames)))
        for frame, (_, file) in zip(frames, series):
            points = next(iter(read_vtp(file)["Points"].values()))[:, :2]
            for name, part in zip(("plane", "upper", "lower"), np.split(points, 3)):
                frame["crack " + name] = part - original
    return {name: np.array([f[name] for f in frames], float) for name in frames[0]}


def compare(case, program, folder):
    """[(field, largest relative difference, step of the first one above the tolerance or None)]"""
    mine, theirs = oracle_frames(case), engine_frames(case, program, folder)
    rows = []
    for name, a in mine.items():
        b = theirs[name]
        if a.shape != b.shape:
            raise RuntimeError("%s: %s values from the oracle, %s from the engine" % (name, a.shape, b.shape))
        if not np.isfinite(b).all():
            raise RuntimeError("%s: not finite" % name)
        scale = np.abs(a).max()
        if name.startswith("crack"):  # a fixed crack: absolute, in cells
            scale = max(scale, 1e-6 * case["grid"]["cell"])
        per_step = np.abs(a - b).max(axis=(1, 2)) / scale
        above = np.flatnonzero(per_step > TOLERANCE)
        rows.append((name, per_step.max(), int(above[0]) if len(above) else None))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", help="the crampon program")
    parser.add_argument("--case", action="append", default=[], help="only cases whose name contains this text")
    parser.add_argument("--share", type=int, default=1, metavar="N", help="only the first of N parts of the steps")
    parser.add_argument("--folder", help="keep inputs and results here")
    parser.add_argument("--list", action="store_true", help="print the names of the cases")
    arguments = parser.parse_args()
    chosen = [c for c in all_cases() if not arguments.case or any(text in c["name"] for text in arguments.case)]
    if arguments.list:
        print("\n".join(c["name"] for c in chosen))
        return 0
    if not arguments.program or not chosen:
        parser.error("no program" if chosen else "no case of that name")
    for case in chosen:
        case["steps"] = max(case["steps"] // arguments.share, 2)
    passed = failed = 0
    with tempfile.TemporaryDirectory() as temporary:
        for case in chosen:
            try:
                rows = compare(case, os.path.abspath(arguments.program), arguments.folder or temporary)
                good = all(first is None for _, _, first in rows)
                text = "  ".join("%s %.1e" % (name, worst) + ("" if first is None else " (from step %d)" % first)
                                 for name, worst, first in rows)
            except Exception as problem:
                good, text = False, "%s: %s" % (type(problem).__name__, problem)
                if not isinstance(problem, RuntimeError):
                    text += "\n" + traceback.format_exc()
            passed, failed = passed + good, failed + (not good)
            print("%s  %-55s %s" % ("passed" if good else "FAILED", case["name"], text), flush=True)
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
