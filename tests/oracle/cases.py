"""Small problems that exercise everything the oracle knows, each stated once. option_cases.py has those of single options and rules.

Soft material, E = 100 kPa and density 1000 kg/m3 (waves at about 10 m/s), cells of 1/128 m (grid lines and particle
lattices are then exact in binary), 20 to 60 steps of about a fifth of
the Courant limit. Initial velocities vary smoothly in space so that no pair of faces starts with a relative velocity that is
zero but for rounding: the state of contact would then be a matter of the order of additions.
"""
import math

from shapes import SHAPES

H = 1 / 128
DT = 1.5e-4


def block(low, high, velocity, per_cell=2, shift=(0.0, 0.0), thickness=1.0):
    """Particles of a rectangle in cells: rows x, y, volume, vx, vy; velocity of (x, y) in cells, m/s."""
    d = H / per_cell
    rows = []
    for j in range(round((high[1] - low[1]) * per_cell)):
        for i in range(round((high[0] - low[0]) * per_cell)):
            x = (low[0] + shift[0]) * H + (i + 0.5) * d
            y = (low[1] + shift[1]) * H + (j + 0.5) * d
            rows.append((x, y, d * d * thickness) + tuple(velocity(x / H, y / H)))
    return rows


def path(*points):
    return [(x * H, y * H) for x, y in points]


def material(law="elastic_small_strain", **changes):
    return {"m": dict({"law": law, "E": 1e5, "nu": 0.3, "density": 1000.0}, **changes)}


def base(name, particles, **more):
    case = {"name": name, "grid": {"origin": (0.0, 0.0), "size": (16 * H, 16 * H), "cell": H}, "dt": DT, "steps": 40,
            "materials": material(), "bodies": [{"material": "m", "particles": particles}]}
    case.update(more)
    return case


def closing(speed):
    """Halves above and below y = 7 cells run into each other with shear and a gradient along x."""
    def velocity(x, y):
        side = 1.0 if y > 7 else -1.0
        return speed * (0.4 * side + 0.05 * (x - 6)), -speed * side * (0.5 + 0.08 * (x - 4)) + 0.02 * speed * (y - 7)
    return velocity


def breathing(x, y):
    """Smooth field with opening, closing and shear in different places."""
    return (0.2 * math.sin(0.7 * x + 0.3 * y) - 0.1 * math.cos(0.9 * y), 0.25 * math.cos(0.5 * x - 0.8 * y) - 0.03 * (y - 7) * x / 6)


SLANTED = path((2.5, 6.83), (5.1, 7.06), (7.4, 6.97), (9.2, 7.11))
LAWS = [("stick", {}), ("frictionless", {}), ("coulomb", {"friction": 0.3}), ("none", {}), ("bonded", {})]


# Halves pressed together from the first step on. Without it MUSL and USL have no force at all in step 1, and after Task 2 the
# normal velocity of Task 4 is zero but for rounding, which would then choose the state of the pair.
PRESS = [{"kind": "total_force", "low": (0.0, 7 * H), "high": (16 * H, 16 * H), "value": (0.0, -50.0)},
         {"kind": "total_force", "low": (0.0, 0.0), "high": (16 * H, 7 * H), "value": (0.0, 50.0)}]


def closing_cases():
    """One crack, closed by moving halves: each law, both schemes, both detections, each update and shape somewhere."""
    choices = [
        ("consistent", "displacement", "coulomb", "usavg", "linear"), ("consistent", "displacement", "frictionless", "musl", "gimp"),
        ("consistent", "displacement", "stick", "usf", "bspline"), ("consistent", "displacement", "coulomb", "usl", "linear"),
        ("consistent", "volume", "coulomb", "usavg", "linear"), ("consistent", "displacement", "coulomb", "usavg", "bspline"),
        ("literal", "displacement", "coulomb", "usavg", "linear"), ("literal", "volume", "coulomb", "musl", "linear"),
        ("literal", "volume", "frictionless", "usavg", "bspline"), ("literal", "volume", "stick", "usf", "linear"),
        ("literal", "displacement", "stick", "usl", "gimp"), ("consistent", "displacement", "none", "usavg", "gimp"),
        ("consistent", "displacement", "bonded", "usavg", "bspline"),
        ("consistent", "displacement", "coulomb", "usavg", "cubic_bspline"), ("literal", "volume", "frictionless", "musl", "cubic_bspline")]
    for scheme, detection, law, update, shape in choices:
        yield base("closing_%s_%s_%s_%s_%s" % (scheme, detection, law, update, shape),
                   block((3, 4), (9, 10), closing(0.5), shift=(0.03, -0.02)), stress_update=update, shape=shape, loads=PRESS,
                   contact={"scheme": scheme, "detection": detection},
                   cracks=[dict({"points": SLANTED, "law": law}, **dict(LAWS)[law])])


def volume_cases():
    """Halves that overlap by a fifth of a cell, so that V_rel lies below, between and above the thresholds along the crack."""
    overlapping = block((3, 4), (9, 7), breathing, shift=(0.02, 0.1)) + block((3, 7), (9, 10), breathing, shift=(0.01, -0.1))
    for approach in (True, False):
        for law in ("coulomb", "frictionless", "stick"):
            yield base("volume_%s_%s" % ("approach" if approach else "n03", law), overlapping,
                       contact={"scheme": "literal", "detection": "volume", "volume_separated": 0.97, "volume_contact": 1.08,
                                "require_approach": approach},
                       cracks=[dict({"points": path((2.2, 7.02), (9.9, 6.97)), "law": law}, **dict(LAWS)[law])])


def crossing_cases():
    off = {"a": path((3.6, 7.1), (8.7, 7.34)), "b": path((6.2, 4.3), (6.4, 9.7)), "c": path((4.1, 5.2), (8.4, 9.3))}
    on = {"a": path((4, 7), (6, 7), (8, 7)), "b": path((6, 5), (6, 9)), "c": path((4, 5), (6, 7), (8, 9))}
    for where, lines in (("off_nodes", off), ("on_nodes", on)):
        for names in ("ab", "abc"):
            for law in ("bonded", "frictionless", "coulomb", "stick"):
                fixed = where == "on_nodes" and law == "frictionless"
                yield base("crossing_%s_%d_%s" % (where, len(names), law), block((3, 4), (9, 10), breathing, shift=(0.01, 0.02)),
                           cracks=[dict({"points": lines[n], "law": law, "fixed": fixed}, **dict(LAWS)[law]) for n in names],
                           shape={"bonded": "bspline", "frictionless": "linear", "coulomb": "gimp", "stick": "linear"}[law],
                           steps=30)
    yield base("crossing_bonded_and_coulomb", block((3, 4), (9, 10), breathing, shift=(0.01, 0.02)),
               cracks=[{"points": off["a"], "law": "bonded"}, {"points": off["b"], "law": "coulomb", "friction": 0.2}], steps=30)
    for law in ("frictionless", "coulomb"):
        yield base("crossing_literal_%s" % law, block((3, 4), (9, 10), breathing, shift=(0.01, 0.02)),
                   cracks=[dict({"points": off[n], "law": law}, **dict(LAWS)[law]) for n in "ab"],
                   contact={"scheme": "literal", "detection": "volume"}, steps=30)


def geometry_cases():
    arc = [(6.1 + 2.3 * math.cos(a), 6.2 + 2.3 * math.sin(a)) for a in [0.2 + 0.4 * k for k in range(8)]]
    for shape in SHAPES:
        yield base("curved_%s" % shape, block((3, 4), (9, 10), breathing, shift=(0.013, 0.021)), shape=shape,
                   cracks=[{"points": path(*arc), "law": "coulomb", "friction": 0.25}])
    yield base("through_nodes", block((3, 4), (9, 10), closing(0.4)),
               cracks=[{"points": path((2.5, 7), (4, 7), (5, 7), (7, 7)), "law": "coulomb", "friction": 0.3, "fixed": True}])
    yield base("edge_to_edge", block((3, 4), (9, 10), closing(0.4)),
               cracks=[{"points": path((2.4, 7.2), (6, 7.05), (9.6, 6.9)), "law": "frictionless"}])
    yield base("drifting_across_nodes", block((3, 4), (9, 10), lambda x, y: (2 + 0.3 * math.sin(y), 3 + breathing(x, y)[1])),
               cracks=[{"points": path((3.5, 6.9), (8.2, 6.97)), "law": "coulomb", "friction": 0.3},
                       {"points": path((5.95, 4.6), (5.9, 9.2)), "law": "frictionless"}], steps=60)


def boundary_cases():
    slab = lambda: block((3, 4), (9, 8), lambda x, y: (0.05 * math.sin(x), 0.04 * math.cos(0.5 * y)))
    left, right = {"low": (2.9 * H, 0.0), "high": (3.1 * H, 16 * H)}, {"low": (8.9 * H, 0.0), "high": (9.1 * H, 16 * H)}
    for force in ("incremental", "n13", "zero"):
        for order in ("contact_first", "boundary_first"):
            ramp = 0.3 if force == "zero" else "0.3*sin(400*t)+0.1"
            yield base("boundary_%s_%s" % (force, order), slab(), fixed_force=force, order=order,
                       stress_update={"incremental": "usavg", "n13": "usavg", "zero": "usf"}[force],
                       boundaries=[dict(left, vx=0.0, vy=0.0), dict(right, vx=ramp)],
                       cracks=[{"points": path((4.5, 6.2), (7.6, 6.1)), "law": "coulomb", "friction": 0.3}])
    for shape in ("bspline", "cubic_bspline"):
        yield base("boundary_" + shape, slab(), shape=shape, boundaries=[dict(left, vx=0.0, vy=0.0), dict(right, vx="100*t")])


def symmetry_cases():
    for shape in SHAPES:
        yield base("symmetry_part_%s" % shape, block((3, 6), (11, 9), lambda x, y: (0.1 * math.sin(x), 0.1 * x / (y - 4))), shape=shape,
                   symmetries=[{"axis": 1, "at": 6 * H, "side": 1, "low": 7 * H}], analysis="plane_stress")


def material_cases():
    def spin(x, y):
        return -25 * H * (y - 8) + 0.1 * math.sin(x), 25 * H * (x - 8) + 0.05 * math.cos(y)
    yield base("spin_large_rotation", block((5, 5), (11, 11), spin), materials=material("elastic_large_rotation"), shape="gimp",
               cracks=[{"points": path((6.3, 8.1), (9.6, 8.2)), "law": "coulomb", "friction": 0.3}], steps=60)
    yield base("neo_hookean_stretch", block((3, 6), (11, 9), lambda x, y: (3 * (x - 7) / 4, 0.2 * math.sin(x))),
               materials=material("neo_hookean"), shape="bspline", stress_update="musl", steps=60)
    # Yields at a strain of 2 %, and in parts of the block again on the way back.
    steel = material("j2_plasticity", yield_stress=2e3, hardening_modulus=8e3)
    for analysis, update, shape in (("plane_strain", "usavg", "gimp"), ("plane_stress", "musl", "bspline")):
        yield base("j2_plasticity_%s" % analysis, block((3, 6), (11, 9), lambda x, y: (3 * (x - 7) / 4 - 0.5 * (y - 7), 0.6 * math.sin(x))),
                   materials=steel, shape=shape, stress_update=update, analysis=analysis, steps=60)
    t = 0.002
    yield base("plane_stress_thin", block((3, 4), (9, 10), breathing, thickness=t), analysis="plane_stress",
               bodies=[{"material": "m", "thickness": t, "particles": block((3, 4), (9, 10), breathing, thickness=t)}],
               loads=[{"kind": "force_each", "low": (8.5 * H, 0.0), "high": (9 * H, 16 * H), "value": (2e-3, 0.0)}],
               contact={"scheme": "literal", "detection": "volume"},
               cracks=[{"points": path((4.2, 7.1), (7.4, 7.3)), "law": "coulomb", "friction": 0.4}])
    yield base("plane_stress_large_rotation", block((3, 4), (9, 8), lambda x, y: (2 * breathing(x, y)[0] + (x - 6), breathing(x, y)[1])),
               materials=material("elastic_large_rotation"), analysis="plane_stress")
    yield base("damping_and_loads", block((3, 4), (9, 8), breathing), damping=80.0, body_force=(0.0, -9.81), shape="gimp",
               loads=[{"kind": "total_force", "low": (3 * H, 0.0), "high": (4 * H, 16 * H), "value": (-2.0, "5*cos(300*t)")}])
    two = material()
    two["heavy"] = {"law": "elastic_large_rotation", "E": 3e5, "nu": 0.2, "density": 2500.0}
    yield base("two_bodies", [], materials=two, body_force=(1.0, -2.0),
               bodies=[{"material": "m", "particles": block((3, 4), (6, 8), breathing)},
                       {"material": "heavy", "particles": block((6, 4), (9, 8), breathing)}])


def all_cases():
    return [case for family in (closing_cases, volume_cases, crossing_cases, geometry_cases, boundary_cases, symmetry_cases, material_cases)
            for case in family()]
