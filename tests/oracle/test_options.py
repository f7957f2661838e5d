#!/usr/bin/env python3
"""Checks of the oracle's single options by themselves: identities that hold whatever the engine does. Prints as test_cramp.py."""
import math
import sys

import cramp
import option_cases
from test_cramp import FIELDS, H, largest_difference, main, same


def named(family, name):
    return next(c for c in family() if c["name"] == name)


def mirrored_rows(case, axis, at):
    """Particles of the case and their mirror images."""
    rows = case["bodies"][0]["particles"]
    def turn(row):
        row = list(row)
        row[axis], row[3 + axis] = 2 * at - row[axis], -row[3 + axis]
        return tuple(row)
    return rows + [turn(row) for row in rows]


def half_equals_full():
    """Cracks that meet a mirror at an angle, contact by distance and by volume: half a model and the whole of it."""
    half_cases = [named(option_cases.meeting_plane_cases, "meeting_plane_" + shape) for shape in ("linear", "gimp", "bspline", "cubic_bspline")]
    half_cases.append(named(option_cases.volume_option_cases, "initial_volume_mirror"))
    for half in half_cases:
        at = half["symmetries"][0]["at"]
        crack = half["cracks"][0]
        points = [v for v in crack["points"] if v[0] >= at]
        whole = [(2 * at - x, y) for x, y in reversed(points) if x > at] + points
        full = dict(half, symmetries=[], cracks=[dict(crack, points=whole, fixed=True)],
                    grid={"origin": (-16 * H, 0.0), "size": (32 * H, 16 * H), "cell": H},
                    bodies=[{"material": "m", "particles": mirrored_rows(half, 0, at)}])
        half = dict(half, cracks=[dict(crack, fixed=True)])
        a, b = cramp.run(half), cramp.run(full)
        acted = cramp.run(dict(half, cracks=[dict(half["cracks"][0], law="none")]))
        same(a.particles, b.particles[:len(a.particles)], 1e-11)  # round-off of 20 steps
        assert largest_difference(a.particles, acted.particles, FIELDS["velocity"]) > 1e-3, half["name"]


def body_force_is_a_force_on_each():
    """Weight towards a mirror from a body force, against the whole block pulled by forces on its particles from both sides."""
    for half in option_cases.gravity_cases():
        at, mass = half["symmetries"][0]["at"], 1000.0 * half["bodies"][0]["particles"][0][2]
        loads = [{"kind": "force_each", "low": (0.0, -16 * H + (at + 16 * H if up > 0 else 0.0)), "high": (16 * H, 16 * H if up > 0 else at),
                  "value": (3.0 * mass, "%r*(-50-9000*t)" % (up * mass))} for up in (1, -1)]
        full = dict(half, symmetries=[], body_force=(0.0, 0.0), loads=loads, bodies=[{"material": "m", "particles": mirrored_rows(half, 1, at)}])
        a, b = cramp.run(half), cramp.run(full)
        same(a.particles, b.particles[:len(a.particles)], 1e-12)


def a_condition_in_two_parts():
    """One velocity given by two conditions that follow each other is the same as by one."""
    for force in ("incremental", "n13", "zero"):
        case = named(option_cases.conditions_cases, "handed_over_" + force)
        left, right, later = case["boundaries"]
        formula = "0.1+40*t"
        split = cramp.run(dict(case, boundaries=[left, dict(right, vx=formula), dict(later, vx=formula)]))
        one = dict(right, vx=formula)
        del one["end"]
        same(split.particles, cramp.run(dict(case, boundaries=[left, one])).particles, 0.0)


def one_pair_needs_no_sweeps():
    """One crack: pairs joint or one after another are the same, and a bonded crack is none, light fields included."""
    for case in option_cases.sequential_cases():
        one = dict(case, cracks=case["cracks"][:1])
        joint = dict(one, contact=dict(one["contact"], pairs="joint"))
        same(cramp.run(one, 8).particles, cramp.run(joint, 8).particles, 0.0 if one["cracks"][0]["law"] != "bonded" else 1e-12)
        if one["cracks"][0]["law"] == "bonded":
            same(cramp.run(one, 8).particles, cramp.run(dict(case, cracks=[]), 8).particles, 1e-12)


def bonded_one_after_another_is_not_joined():
    """conventions 13: with two crossing cracks the four pairs, each done once, do not reach the common velocity."""
    case = named(option_cases.sequential_cases, "sequential_literal_bonded")
    assert largest_difference(cramp.run(case).particles, cramp.run(dict(case, cracks=[])).particles, FIELDS["stress"]) > 1e-3


def prescribed_components_stay():
    """Nodes of the wall have its velocity after every step, whatever contact does there."""
    for case in option_cases.crack_at_wall_cases():
        model = cramp.Model(case)
        for _ in range(case["steps"]):
            model.step()
            fields = {}
            for key, p in model.p.items():
                if key[0][0] == 3:
                    assert abs(p[0] / model.m[key] - 0.2 * math.sin(500 * model.t)) < 1e-12
                    fields.setdefault(key[0], []).append(key)
        assert any(len(keys) > 1 for keys in fields.values()), "no crack on the wall"


def ends_outside_go_along():
    """Vertices a cell outside the body, exactly on grid lines, go on as the material inside does: its linear continuation."""
    model = cramp.Model(next(option_cases.vertex_cases()))
    before = model.cracks[0].plane
    model.step()
    moved = [[b[k] - a[k] for k in range(2)] for a, b in zip(before, model.cracks[0].plane)]
    for end, inside in ((0, 1), (3, 2)):
        assert all(1 < moved[end][k] / moved[inside][k] < 4 for k in range(2))  # it stretches along and opens away from the middle
        assert max(map(abs, moved[end])) > 1e-6


if __name__ == "__main__":
    sys.exit(main([half_equals_full, body_force_is_a_force_on_each, a_condition_in_two_parts, one_pair_needs_no_sweeps,
                   bonded_one_after_another_is_not_joined, prescribed_components_stay, ends_outside_go_along]))
