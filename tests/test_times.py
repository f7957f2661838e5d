#!/usr/bin/env python3
"""Prints how long tests took, from the JUnit file that ctest writes:  test_times.py FILE [HOW_MANY]

The slowest tests, and the sum over each executable. A test that is not labelled "full" should take well under 30 s.
"""
import collections
import pathlib
import sys
import xml.etree.ElementTree as xml


def main():
    cases = [(float(c.get("time", 0)), c.get("name", "")) for c in xml.parse(pathlib.Path(sys.argv[1])).getroot().iter("testcase")]
    how_many = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    print(f"\n{len(cases)} tests took {sum(t for t, _ in cases):.0f} s one after another. The slowest:")
    for seconds, name in sorted(cases, reverse=True)[:how_many]:
        print(f"  {seconds:7.1f} s  {name}{'   <- over 30 s' if seconds > 30 else ''}")
    suites = collections.Counter()
    for seconds, name in cases:
        suites[name.split(".")[0].split("/")[-1]] += seconds
    print("The slowest groups:")
    for name, seconds in suites.most_common(how_many):
        print(f"  {seconds:7.1f} s  {name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
