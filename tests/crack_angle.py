#!/usr/bin/env python3
"""Tells under which angles a crack has grown: from events.csv of a run, of one end of one crack.

    crack_angle.py RESULTS --from X Y --axis X Y [--crack N] [--end 0|1] [--parts P] [--low DEGREES] [--high DEGREES]

The angle is that between the axis and the straight line from where the tip was at the start to where it is after each of P equal parts of its growth,
the last of which is all of it; positive to the left of the axis. Also the time of the first growth, the turn at it, and the mean speed are printed.
With --low and --high the exit code is 1 if the first turn or one of these angles lies outside of them, whatever its sign.
"""
import argparse
import csv
import sys

import numpy as np


def read_growth(folder, crack, end):
    """Times, places and turns of each growth."""
    with open(f"{folder}/events.csv") as file:
        rows = csv.reader(file)
        names = [name.split("[")[0] for name in next(rows)]
        events = [dict(zip(names, map(float, row))) for row in rows]
    growth = [e for e in events if e["event"] > 0 and e["crack"] == crack and e["end"] == end]
    if not growth:
        sys.exit("this end of the crack has not grown")
    return np.array([e["time"] for e in growth]), np.array([[e["x"], e["y"]] for e in growth]), np.array([e["angle"] for e in growth])


def angle_between(axis, way):
    return np.degrees(np.arctan2(axis[0] * way[1] - axis[1] * way[0], np.dot(axis, way)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results")
    parser.add_argument("--from", dest="start", type=float, nargs=2, required=True)
    parser.add_argument("--axis", type=float, nargs=2, required=True)
    parser.add_argument("--crack", type=int, default=0)
    parser.add_argument("--end", type=int, default=1)
    parser.add_argument("--parts", type=int, default=3)
    parser.add_argument("--low", type=float, default=-np.inf)
    parser.add_argument("--high", type=float, default=np.inf)
    arguments = parser.parse_args()

    time, place, turn = read_growth(arguments.results, arguments.crack, arguments.end)
    start = np.array(arguments.start)
    length = np.cumsum(np.linalg.norm(np.diff(np.vstack([start, place]), axis=0), axis=1))
    print(f"first growth at {time[0]:.4g} s, turned by {np.degrees(turn[0]):.1f} degrees; {length[-1]:.4g} m in all", end="")
    print(f", {length[-1] / (time[-1] - time[0]):.3g} m/s" if time[-1] > time[0] else "")
    angles = []
    for part in range(1, arguments.parts + 1):
        k = min(np.searchsorted(length, length[-1] * part / arguments.parts * (1 - 1e-9)), len(length) - 1)
        angles.append(angle_between(arguments.axis, place[k] - start))
        print(f"  after {length[k]:.4g} m: {angles[-1]:.1f} degrees")
    return 0 if all(arguments.low <= abs(angle) <= arguments.high for angle in [np.degrees(turn[0])] + angles) else 1


if __name__ == "__main__":
    sys.exit(main())
