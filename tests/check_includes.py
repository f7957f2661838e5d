#!/usr/bin/env python3
"""Do includes between the rooms of src/crampon point one way only (docs/architecture.md)?

A room may include rooms of a lower level, and neighbours of its own level as long as no two of them need each other.
    check_includes.py             checks the repository
    check_includes.py --self-test shows that a wrong include is found
"""
import pathlib
import re
import sys

LEVELS = [["core"], ["geometry"], ["state", "shape", "material", "contact", "crack"], ["step"], ["input", "output"], ["run", "picture"], ["apps"]]
LEVEL = {room: level for level, rooms in enumerate(LEVELS) for room in rooms}
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]crampon/([^/">]+)/[^">]+[">]', re.M)


def room_of(path):
    """Room of a source file, given relative to the repository."""
    parts = path.parts
    return "apps" if parts[0] == "apps" else parts[2] if len(parts) > 3 else None


def complaints(files):
    """files: {path: text}. One sentence for each include in a forbidden direction."""
    found = []
    sideways = {}
    for path, text in sorted(files.items()):
        room = room_of(path)
        if room not in LEVEL:
            found.append(f"{path}: room '{room}' has no level in tests/check_includes.py")
            continue
        for match in INCLUDE.finditer(text):
            other = match.group(1)
            line = text.count("\n", 0, match.start(1)) + 1
            if other not in LEVEL:
                found.append(f"{path}:{line}: room '{other}' has no level in tests/check_includes.py")
            elif LEVEL[other] > LEVEL[room]:
                found.append(f"{path}:{line}: {room} includes {other}, which stands above it")
            elif other != room and LEVEL[other] == LEVEL[room]:
                sideways.setdefault((room, other), f"{path}:{line}")
    reached = {}
    for room, other in sideways:
        reached.setdefault(room, set()).add(other)
    changed = True
    while changed:  # rooms of one level reachable from each other: closure of a handful of pairs
        changed = False
        for others in reached.values():
            more = set().union(*(reached.get(other, set()) for other in others)) - others
            if more:
                others |= more
                changed = True
    for (room, other), place in sorted(sideways.items()):
        if room in reached.get(other, set()):
            found.append(f"{place}: {room} includes {other}, which in turn needs {room}")
    return found


def self_test():
    path = pathlib.Path
    good = {path("src/crampon/step/a.hpp"): '#include "crampon/core/b.hpp"\n', path("apps/crampon/m.cpp"): '#include "crampon/run/r.hpp"\n'}
    upward = {path("src/crampon/core/a.hpp"): '#pragma once\n#include "crampon/step/b.hpp"\n'}
    one_way = {path("src/crampon/crack/a.hpp"): '#include "crampon/state/b.hpp"\n'}
    cycle = dict(one_way)
    cycle[path("src/crampon/state/c.hpp")] = '#include "crampon/shape/d.hpp"\n'
    cycle[path("src/crampon/shape/e.hpp")] = '#include "crampon/crack/f.hpp"\n'
    assert complaints(good) == [] and complaints(one_way) == []
    assert complaints(upward) == [f"{next(iter(upward))}:2: core includes step, which stands above it"]
    assert len(complaints(cycle)) == 3
    assert complaints({path("src/crampon/attic/a.hpp"): ""})


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return 0
    top = pathlib.Path(__file__).resolve().parent.parent
    files = {}
    for folder in ("src/crampon", "apps"):
        for path in (top / folder).rglob("*"):
            if path.suffix in (".hpp", ".cpp"):
                files[path.relative_to(top)] = path.read_text()
    found = complaints(files)
    print("\n".join(found) if found else f"{len(files)} files: includes point one way")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
