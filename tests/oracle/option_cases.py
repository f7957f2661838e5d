"""Short cases of single options and rules, beside the families of cases.py. 10 to 20 steps each."""
import math
import random

import cases
from cases import H, PRESS, base, block, breathing, path

CRACK_A, CRACK_B = path((3.6, 7.1), (8.7, 7.34)), path((6.2, 4.3), (6.4, 9.7))  # they cross at (6.3, 7.2)


def crossing(name, law, contact, velocity=breathing, **more):
    return base(name, block((3, 4), (9, 10), velocity, shift=(0.01, 0.02)), steps=15, contact=contact,
                cracks=[dict({"points": points, "law": law}, **dict(cases.LAWS)[law]) for points in (CRACK_A, CRACK_B)], **more)


def converging(seed):
    """Every particle towards the point where the cracks cross, at a speed and with a scatter of its own."""
    source = random.Random(seed)

    def velocity(x, y):
        far = math.hypot(x - 6.3, y - 7.2)
        speed = source.uniform(0.2, 1.0)
        return (speed * (6.3 - x) / far + source.uniform(-0.3, 0.3), speed * (7.2 - y) / far + source.uniform(-0.3, 0.3))
    return velocity


def sequential_cases():
    """Pairs done once, one after another; bonded cracks are then pairs like others (conventions 13, 14)."""
    for law in ("stick", "coulomb", "bonded"):
        yield crossing("sequential_literal_%s" % law, law, {"scheme": "literal", "pairs": "sequential"}, velocity=converging(7))
    yield crossing("sequential_consistent_coulomb", "coulomb", {"pairs": "sequential"}, velocity=converging(7), shape="bspline")
    yield crossing("sequential_consistent_bonded", "bonded", {"pairs": "sequential"})
    # uGIMP leaves fields with 1e-12 of a node's mass: the screen of conventions 37 does not part bonded faces (conventions 44, 51)
    yield crossing("sequential_light_bonded", "bonded", {"pairs": "sequential"}, shape="gimp")


def joint_cases():
    """Rings of four fields in contact, swept until nothing moves. With stick the order of the pairs shows (3 % here)."""
    for law in ("coulomb", "stick"):
        yield crossing("ring_of_pairs_%s" % law, law, {"scheme": "literal"}, velocity=converging(2))


def meeting_plane_cases():
    """A crack that meets the mirror x = 3 cells at an angle: there its normal is the plane's tangent (docs/theory/contact.md, normals).

    Wide shape functions see nodes beyond the plane, so the crack goes on there as its mirror image.
    """
    def velocity(x, y):
        return 0.1 * (x - 3), (-0.4 if y > 6.6 + 0.19 * (x - 3) else 0.4) + 0.05 * math.sin(2 * x)
    particles = block((3, 4), (9, 10), velocity, shift=(0.0, 0.02))
    plane = [{"axis": 0, "at": 3 * H, "side": 1}]
    yield base("meeting_plane_linear", particles, symmetries=plane, steps=20,
               cracks=[{"points": path((3, 6.6), (7.3, 7.42)), "law": "frictionless"}])
    for shape in ("gimp", "bspline", "cubic_bspline"):
        yield base("meeting_plane_%s" % shape, particles, symmetries=plane, steps=20, shape=shape,
                   cracks=[{"points": path((0.8, 7.02), (3, 6.6), (5.2, 7.02), (7.3, 7.42)), "law": "frictionless", "fixed": True}])


def gravity_cases():
    """Block on a mirror with gravity towards it: mirrored particles weigh the other way."""
    for shape in ("gimp", "bspline", "cubic_bspline"):
        yield base("gravity_on_mirror_%s" % shape, block((3, 6), (9, 9), lambda x, y: (0.02 * math.sin(x), 0.0), shift=(0.04, -0.05)),
                   shape=shape, body_force=(3.0, "-50-9000*t"), symmetries=[{"axis": 1, "at": 6 * H, "side": 1}], steps=20)


def conditions_cases():
    """Conditions of limited time on one component: handed over, overlapping, released and taken up again.

    Steps of 2^-13 s: starts of steps and the times given are the same numbers.
    """
    dt = 2.0 ** -13
    left, right = {"low": (2.9 * H, 0.0), "high": (3.1 * H, 16 * H)}, {"low": (8.9 * H, 0.0), "high": (9.1 * H, 16 * H)}
    slab = block((3, 4), (9, 8), lambda x, y: (0.05 * math.sin(x), 0.04 * math.cos(0.5 * y)))

    def case(name, boundaries, **more):
        return base(name, slab, dt=dt, steps=16, boundaries=boundaries, **more)
    handed_over = [dict(left, vx=0.0, vy=0.0), dict(right, vx=0.1, end=7 * dt), dict(right, vx=-0.2, start=7 * dt)]
    for force in ("incremental", "n13", "zero"):
        yield case("handed_over_%s" % force, handed_over, fixed_force=force)
    yield case("handed_over_bspline_boundary_first", handed_over, shape="bspline", order="boundary_first")
    upper = dict(right, low=(8.9 * H, 5.5 * H), vx=-0.1, vy="30*t", start=4 * dt, end=9 * dt)
    yield case("last_stated_holds", [dict(left, vx=0.0), dict(right, vx="0.1+50*t"), upper])
    yield case("released_and_held_again", [dict(left, vx=0.0), dict(right, vx=0.1, end=5 * dt), dict(right, vx=-0.2, start=9.5 * dt)])


def crack_at_wall_cases():
    """A slanted crack through nodes with a prescribed velocity: contact leaves what is prescribed alone.

    Boundary conditions first: in all tasks. Contact first: in Task 4.
    """
    def velocity(x, y):
        return 0.1 * math.cos(y), (-0.5 if y > 6.65 - 0.42 * (x - 3) else 0.3) + 0.05 * math.sin(x)
    wall = [{"low": (2.9 * H, 0.0), "high": (3.1 * H, 16 * H), "vx": "0.2*sin(500*t)"}]
    for order, scheme, force in (("boundary_first", "literal", "n13"), ("boundary_first", "literal", "zero"),
                                 ("boundary_first", "consistent", "n13"), ("boundary_first", "consistent", "zero"),
                                 ("boundary_first", "consistent", "incremental"), ("contact_first", "consistent", "incremental"),
                                 ("contact_first", "literal", "n13")):
        yield base("crack_at_wall_%s_%s_%s" % (order, scheme, force), block((3, 4), (9, 8), velocity, shift=(0.02, 0.01)),
                   order=order, fixed_force=force, boundaries=wall, steps=15, contact={"scheme": scheme},
                   cracks=[{"points": path((2.4, 6.9), (6.2, 5.3)), "law": "frictionless"}])


def volume_option_cases():
    """V_rel against the volume of all particles at the start; volumes that are areas (N03 Eqs. 8 to 10)."""
    def velocity(x, y):  # opens near the mirror, closes farther off; the right edge moves outwards
        return 0.1 * (x - 3), (1 if y > 7.5 else -1) * 0.3 * math.cos(0.5 * (x - 3)) + 0.02 * math.sin(x)
    yield base("initial_volume_mirror", block((3, 5), (9, 10), velocity, shift=(0.0, 0.03)), shape="bspline", steps=15,
               symmetries=[{"axis": 0, "at": 3 * H, "side": 1}],
               contact={"scheme": "literal", "detection": "volume", "reference_volume": "initial", "volume_contact": 1.01,
                        "require_approach": False},
               cracks=[{"points": path((0.8, 7.54), (3, 7.48), (5.2, 7.54), (9.6, 7.66)), "law": "stick", "fixed": True}])

    def stretch(x, y):  # along the crack: the sheet gets a fifth thinner while its faces close
        return 1.2 * (x - 6), -0.2 * (1 if y > 7.15 else -1) * (1 + 0.1 * math.sin(x))
    yield base("stretched_sheet", block((3, 4), (9, 10), stretch, shift=(0.02, 0.03)), materials=cases.material("elastic_large_rotation"),
               analysis="plane_stress", steps=20,
               contact={"scheme": "literal", "detection": "volume", "volume_separated": 0.95, "volume_contact": 1.2},
               cracks=[{"points": path((3.4, 7.1), (8.4, 7.2)), "law": "coulomb", "friction": 0.3}])


def vertex_cases():
    """Ends of a crack on the grid lines one cell outside the body: no node there has mass, they go with their neighbours."""
    def spin(x, y):
        return -0.2 * (y - 7), 0.2 * (x - 6) - 0.1 * (1 if y > 7 else -1)
    yield base("vertex_outside", block((3, 4), (9, 10), spin), loads=PRESS, steps=15,
               cracks=[{"points": path((2, 6.8), (4.4, 6.9), (7.1, 7.1), (10, 7.2)), "law": "frictionless"}])


def position_cases():
    """Positions by N03 Eq. 30; with the default, all other cases move particles with the velocity that strains them."""
    for update, shape in (("usavg", "gimp"), ("musl", "linear"), ("usf", "bspline")):
        yield base("positions_n03_%s" % update, block((3, 4), (9, 10), cases.closing(0.5), shift=(0.03, -0.02)), stress_update=update, shape=shape,
                   positions="n03", loads=PRESS, cracks=[{"points": cases.SLANTED, "law": "coulomb", "friction": 0.3}])
    yield base("positions_strain_usf", block((3, 4), (9, 10), cases.closing(0.5), shift=(0.03, -0.02)), stress_update="usf", shape="gimp",
               loads=PRESS, cracks=[{"points": cases.SLANTED, "law": "coulomb", "friction": 0.3}])


def domain_cases():
    """Domains that stretch and turn: on bodies that are cut, hang on a face, meet a mirror."""
    rubber = cases.material("neo_hookean")
    def pull(x, y):
        return 1.2 * (x - 6) - 1.8 * (y - 7), 1.8 * (x - 6) - 0.6 * (y - 7)
    for update in ("usavg", "musl", "usf", "usl"):
        yield base("domains_%s" % update, block((3, 4), (9, 10), pull, shift=(0.03, -0.02)), stress_update=update, shape="cpdi", materials=rubber,
                   loads=PRESS, cracks=[{"points": cases.SLANTED, "law": "coulomb", "friction": 0.3}])
    yield base("domains_at_mirror", block((3, 4), (9, 10), pull), shape="cpdi", materials=rubber, symmetries=[{"axis": 0, "at": 3 * H, "side": 1}])


def all_cases():
    families = (sequential_cases, joint_cases, meeting_plane_cases, gravity_cases, conditions_cases, crack_at_wall_cases,
                volume_option_cases, vertex_cases, position_cases, domain_cases)
    return cases.all_cases() + [case for family in families for case in family()]
