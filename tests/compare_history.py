#!/usr/bin/env python3
"""Compares a column of a run over time with a reference, by the root mean square of the difference.

    compare_history.py RESULTS COLUMN --table FILE   [--scale S] [--from T] [--to T] [--bar RMS]
    compare_history.py RESULTS COLUMN --formula TEXT [--scale S] [--from T] [--to T] [--bar RMS]
    compare_history.py --as-formula FILE [--scale S]

RESULTS is the folder of a run and COLUMN one of history.csv, without its unit; several columns may be joined by a formula of numpy, as "K_I.crack.end/2".
A table has lines "time,value"; lines that start with # are comments. A formula is one of numpy in t, in s. The reference is multiplied by S.
Against a table the column is read at the times of the table, against a formula in every row of the history. With --bar the exit code is 1 if the
root mean square of the difference is larger. The third form prints the table as a formula in "time", straight between its points, for
crampon draw --history "reference [UNIT] = FORMULA".
"""
import argparse
import re
import sys

import numpy as np


def read_history(folder):
    with open(f"{folder}/history.csv") as file:
        names = [name.split("[")[0] for name in file.readline().strip().split(",")]
        return dict(zip(names, np.atleast_2d(np.genfromtxt(file, delimiter=",")).T))


def read_table(path, scale):
    rows = np.genfromtxt(path, delimiter=",", comments="#")
    return rows[:, 0], rows[:, 1] * scale


def column_of(history, text):
    """A column, or a formula of columns; the longest names are replaced first, since one may be the start of another."""
    values = {}
    for name in sorted(history, key=len, reverse=True):
        if name in text:
            word = f"column_{len(values)}_"
            text = re.sub(r"(?<![\w.])" + re.escape(name) + r"(?![\w.])", word, text)
            values[word] = history[name]
    try:
        return eval(text, {"np": np, "sqrt": np.sqrt, "maximum": np.maximum}, values)
    except NameError as error:
        sys.exit(f"{error}: history.csv has the columns {', '.join(history)}")


def as_formula(t, y):
    """The sum of what each point changes of the slope."""
    slopes = np.diff(y) / np.diff(t)
    text = f"{y[0]:.6g}"
    for start, change in zip(t, np.append(np.diff(slopes, prepend=0.0), -slopes[-1])):
        text += f" + {change:.6g}*max(time - {start:.6g}, 0)"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="?")
    parser.add_argument("column", nargs="?")
    parser.add_argument("--table")
    parser.add_argument("--formula")
    parser.add_argument("--as-formula", metavar="TABLE")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--from", dest="start", type=float, default=-np.inf)
    parser.add_argument("--to", dest="end", type=float, default=np.inf)
    parser.add_argument("--bar", type=float)
    arguments = parser.parse_args()
    if arguments.as_formula:
        print(as_formula(*read_table(arguments.as_formula, arguments.scale)))
        return 0
    if not arguments.column or (arguments.table is None) == (arguments.formula is None):
        parser.error("RESULTS, COLUMN and one of --table and --formula are needed")

    history = read_history(arguments.results)
    time, measured = history["time"], column_of(history, arguments.column)
    if arguments.table:
        at, reference = read_table(arguments.table, arguments.scale)
        chosen = (at >= arguments.start) & (at <= min(arguments.end, time[-1] * (1 + 1e-9)))
        at, reference = at[chosen], reference[chosen]
        known = np.isfinite(measured)
        measured = np.interp(at, time[known], measured[known])
    else:
        chosen = (time >= arguments.start) & (time <= arguments.end)
        at, measured = time[chosen], measured[chosen]
        reference = eval(arguments.formula, {"t": at, "np": np, "pi": np.pi, "sqrt": np.sqrt, "maximum": np.maximum}) * arguments.scale
    if at.size == 0:
        sys.exit("no times to compare at")

    difference = measured - reference
    rms, largest = np.sqrt(np.mean(difference**2)), np.max(np.abs(reference))
    worst = np.argmax(np.abs(difference))
    print(f"{arguments.column}: {at.size} times from {at[0]:.4g} s to {at[-1]:.4g} s")
    print(f"  root mean square of the difference {rms:.4g}, {rms / largest:.2%} of the largest value of the reference, {largest:.4g}")
    print(f"  mean of the difference {np.mean(difference):.4g}; largest {difference[worst]:.4g} at {at[worst]:.4g} s")
    if arguments.bar is None:
        return 0
    met = rms <= arguments.bar
    print(f"  {'met' if met else 'missed'}: the bar is {arguments.bar:g}")
    return 0 if met else 1


if __name__ == "__main__":
    sys.exit(main())
