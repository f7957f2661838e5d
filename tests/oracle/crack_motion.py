"""Motion of crack planes and surfaces: N03 Eq. 32 and conventions 39 for the plane; surface points are carried by particles.

The plane moves with v = sum S v_cm where all nodes about have mass, else with the mean of its surface points. A surface point has the displacement
that a linear fit to the particles about it, on its side of all cracks, has there; the fit is made once. Ends that lie outside of all particles,
or on the edge of one, are no tips: there the crack goes on for those who ask what it cuts.
"""
import copy
import math

from crossing import segment_normal
from shapes import point_2d

REACHES = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0)  # cells
LEAST_VARIANCE, MOST_LEVERAGE = 0.02, 8.0


def extend(model):
    h = model.grid.h
    half = 0.5 * h * (2 * model.half_size) + 1e-9 * h

    def material(x):
        return any(abs(x[0] - p.X[0]) <= half and abs(x[1] - p.X[1]) <= half for p in model.particles)

    def beyond(end, before):
        L = math.hypot(end[0] - before[0], end[1] - before[1])
        out = [(end[k] - before[k]) / L for k in range(2)]

        def free(d):
            return not material([end[k] + out[k] * d for k in range(2)])
        hair = 1e-6 * h
        if not free(hair):
            return 0.0
        length, step = hair, 0.05 * h
        while length < 4 * h:
            if not free(length + step):
                a, b = length, length + step
                for _ in range(40):
                    a, b = ((a + b) / 2, b) if free((a + b) / 2) else (a, (a + b) / 2)
                return (a + b) / 2 - hair
            length += step
        return length
    for crack in model.cracks:
        if crack.plane[0] != crack.plane[-1]:
            crack.extension = beyond(crack.plane[0], crack.plane[1]), beyond(crack.plane[-1], crack.plane[-2])


def choose_carriers(model):
    for crack in model.cracks:
        crack.carriers = {up: [carriers(model, x, beside(model, x, vertex_normal(crack.plane, k), up)) for k, x in enumerate(crack.plane)]
                          for up in (1, -1)}


def beside(model, vertex, n, up):
    """A hair off the plane, on a mirror a hair inside the body."""
    nudge = 1e-8 * model.grid.h
    x = [vertex[c] - up * nudge * n[c] for c in range(2)]
    for mirror in model.symmetries:
        if abs(vertex[mirror.axis] - mirror.at) < nudge:
            x[mirror.axis] = mirror.at + mirror.side * nudge
    return x


def carriers(model, x, seen_from):
    """[(particle, signs of the components of its displacement, weight)]"""
    h, chosen = model.grid.h, []
    for reach in REACHES:
        near = []
        for p in model.particles:
            y = [(p.x[k] - x[k]) / h for k in range(2)]
            # A hair beyond the particle: one on a crack is of neither side (docs/decisions/0010-surface-points.md).
            beyond = tuple(p.x[k] + 1e-6 * (p.x[k] - seen_from[k]) for k in range(2))
            if max(map(abs, y)) < reach and not model.crossings(beyond, tuple(seen_from))[0]:
                near.append((p, (1, 1), y))
        for mirror in model.symmetries:
            for p, signs, y in list(near):
                k = mirror.axis
                image = list(y)
                image[k] += 2 * (mirror.at - x[k] - y[k] * h) / h
                if max(map(abs, image)) < reach:
                    near.append((p, tuple(-s if c == k else s for c, s in enumerate(signs)), image))
        if not near:
            continue
        w = [p.mass * ((1 - abs(y[0]) / reach) * (1 - abs(y[1]) / reach)) ** 2 for p, _, y in near]
        total = sum(w)
        mean = [sum(a * y[k] for a, (_, _, y) in zip(w, near)) / total for k in range(2)]
        C = [[sum(a * (y[i] - mean[i]) * (y[j] - mean[j]) for a, (_, _, y) in zip(w, near)) / total for j in range(2)] for i in range(2)]
        middle, half = (C[0][0] + C[1][1]) / 2, (C[0][0] - C[1][1]) / 2
        root = math.hypot(half, C[0][1])
        angle = 0.5 * math.atan2(C[0][1], half) if root > 1e-12 * middle else 0.0
        slope, leverage = [0.0, 0.0], 0.0
        for e, spread in (((math.cos(angle), math.sin(angle)), middle + root), ((-math.sin(angle), math.cos(angle)), middle - root)):
            if spread >= LEAST_VARIANCE:
                along = mean[0] * e[0] + mean[1] * e[1]
                slope = [slope[k] - e[k] * along / spread for k in range(2)]
                leverage += along * along / spread
        chosen = [(p, signs, a / total * (1 + sum((y[k] - mean[k]) * slope[k] for k in range(2)))) for a, (p, signs, y) in zip(w, near)]
        if middle - root >= LEAST_VARIANCE and leverage <= MOST_LEVERAGE:
            break
    return chosen


def move_cracks(model):
    momentum, mass = {}, {}
    for key, p in model.p.items():
        total = momentum.setdefault(key[0], [0.0, 0.0])
        mass[key[0]] = mass.get(key[0], 0.0) + model.m[key]
        for k in range(2):
            total[k] += p[k]
    for crack in model.cracks:
        upper, lower, plane = carried_motion(crack, lambda p: p.x)
        for k, x in enumerate(crack.plane):
            v = node_average(model, x, momentum, mass)
            if v is not None:
                plane[k] = [model.dt * c for c in v]
        move_points(crack, upper, lower, plane)
        if not crack.fixed:
            crack.plane = [between_surfaces(model, crack, k) for k in range(len(crack.plane))]


def carry_cracks(model):
    """After positions of particles have been changed otherwise than by a step: surfaces go with their carriers, the plane with both."""
    for crack in model.cracks:
        move_points(crack, *carried_motion(crack, lambda p: p.x))


def present_crack(model, crack):
    """The crack with its points at the present time, which those that the step works with lead."""
    if not model.lead:
        return crack
    now = copy.copy(crack)
    now.upper, now.lower = list(crack.upper), list(crack.lower)
    move_points(now, *carried_motion(crack, lambda p: p.present(model.lead)))
    return now


def carried_motion(crack, position):
    """How far upper and lower points are from where their carriers are, and vertices of the plane with both; None: nothing says it."""
    moved = []
    for up, points in ((1, crack.upper), (-1, crack.lower)):
        new = [carried(crack.original[k], held, position) if held else None for k, held in enumerate(crack.carriers[up])]
        moved.append([None if x is None else [x[c] - old[c] for c in range(2)] for x, old in zip(new, points)])
    plane = []
    for sides in zip(*moved):
        known = [s for s in sides if s is not None]
        plane.append([sum(s[c] for s in known) / len(known) for c in range(2)] if known else None)
    return moved[0], moved[1], plane


def move_points(crack, upper, lower, plane):
    plane = fill(plane)
    for motion, points in ((upper, crack.upper), (lower, crack.lower)):
        for k, x in enumerate(points):
            points[k] = tuple(x[c] + (plane[k] if motion[k] is None else motion[k])[c] for c in range(2))
    if not crack.fixed:
        crack.plane = [tuple(x[c] + d[c] for c in range(2)) for x, d in zip(crack.plane, plane)]


def carried(original, held, position):
    return [original[c] + sum(w * signs[c] * (position(p)[c] - p.X[c]) for p, signs, w in held) for c in range(2)]


def node_average(model, point, momentum, mass):
    weight, v = 0.0, [0.0, 0.0]
    for node, S in point_2d(point, model.grid):
        if node in mass:
            weight += S
            for k in range(2):
                v[k] += S * momentum[node][k] / mass[node]
    return None if weight < 1 - 1e-9 else v


def vertex_normal(plane, k):
    """Unit normal at a vertex, from above to below: the mean of the segments that meet there."""
    n = [0.0, 0.0]
    for segment in (k - 1, k):
        if 0 <= segment < len(plane) - 1:
            s = segment_normal(plane, segment)
            n = [n[0] + s[0], n[1] + s[1]]
    length = math.hypot(*n)
    return n[0] / length, n[1] / length


def between_surfaces(model, crack, k):
    """A vertex that is not between its surface points goes back to their middle, unless they have slid a cell apart."""
    x, h = crack.plane[k], model.grid.h
    on_mirror = {m.axis for m in model.symmetries if abs(x[m.axis] - m.at) < 1e-8 * h}
    n = [0.0 if c in on_mirror else component for c, component in enumerate(vertex_normal(crack.plane, k))]
    size = (n[0] ** 2 + n[1] ** 2) ** 0.5
    n = [component / size for component in n] if size > 0 else n
    up, low = (sum((points[k][c] - x[c]) * n[c] for c in range(2)) for points in (crack.upper, crack.lower))
    normal = vertex_normal(crack.plane, k)
    slid = -(crack.upper[k][0] - crack.lower[k][0]) * normal[1] + (crack.upper[k][1] - crack.lower[k][1]) * normal[0]
    if (up <= 0 <= low) or abs(slid) > h:
        return x
    return tuple(x[c] + 0.5 * (up + low) * n[c] for c in range(2))


def fill(motions):
    """Vertices that nothing moves go with the nearest vertex that something moves (conventions 39)."""
    known = [k for k, v in enumerate(motions) if v is not None]
    if not known:
        return [(0.0, 0.0)] * len(motions)
    return [v if v is not None else motions[min(known, key=lambda j: abs(j - k))] for k, v in enumerate(motions)]
