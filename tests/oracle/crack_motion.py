"""Motion of the crack planes and surfaces: N03 Eq. 32, CONVENTIONS 39, fracture.md 6.4.

v = sum S v_cm / sum S over nodes with mass; surfaces with the fields of their own side. The momenta are those of Task 6.
"""
import math

from crossing import segment_normal
from shapes import point_2d


def move_cracks(model):
    momentum, mass = {}, {}
    for key, p in model.p.items():
        total = momentum.setdefault(key[0], [0.0, 0.0])
        mass[key[0]] = mass.get(key[0], 0.0) + model.m[key]
        for k in range(2):
            total[k] += p[k]
    pending = []
    for crack in model.cracks:
        plane = fill([node_average(model, x, momentum, mass) for x in crack.plane])
        upper, lower = ([side_average(model, crack, k, x, up) or plane[k] for k, x in enumerate(points)]
                        for points, up in ((crack.upper, 1), (crack.lower, -1)))
        pending.append((crack, moved(crack.plane, plane, model.dt), moved(crack.upper, upper, model.dt),
                        moved(crack.lower, lower, model.dt)))
    for crack, plane, upper, lower in pending:
        crack.upper, crack.lower = upper, lower
        if not crack.fixed:
            crack.plane = plane
            if crack.law != "none":
                keep_sides(crack)


def moved(points, velocities, dt):
    return [(x[0] + dt * v[0], x[1] + dt * v[1]) for x, v in zip(points, velocities)]


def node_average(model, point, momentum, mass):
    weight, v = 0.0, [0.0, 0.0]
    for node, S in point_2d(point, model.grid):
        target, R, _ = model.fold(point, node)
        if target in mass:
            weight += S
            for k in range(2):
                v[k] += R[k] * S * momentum[target][k] / mass[target]
    return None if weight == 0 else (v[0] / weight, v[1] / weight)


def vertex_normal(plane, k):
    """Unit normal at a vertex, from above to below: the mean of the segments that meet there."""
    n = [0.0, 0.0]
    for segment in (k - 1, k):
        if 0 <= segment < len(plane) - 1:
            s = segment_normal(plane, segment)
            n = [n[0] + s[0], n[1] + s[1]]
    length = math.hypot(*n)
    return n[0] / length, n[1] / length


def seen_from(model, crack, k, point, up):
    """The surface point, or the plane's vertex just off the plane: while the point is not off it itself, or lies across another crack.
    On a mirror a little inside the body."""
    nudge, vertex, n = 1e-8 * model.grid.h, crack.plane[k], vertex_normal(crack.plane, k)

    def off_mirrors(x):
        for mirror in model.symmetries:
            if abs(vertex[mirror.axis] - mirror.at) < nudge:
                x[mirror.axis] = mirror.at + mirror.side * nudge
        return x
    beside, itself = off_mirrors([vertex[c] - up * nudge * n[c] for c in range(2)]), off_mirrors(list(point))
    if -up * sum((point[c] - vertex[c]) * n[c] for c in range(2)) <= nudge or model.crossings(beside, itself)[0]:
        return beside
    return itself


def side_average(model, crack, k, point, up):
    """v = sum w v / sum w over the fields of this side, w = S min(1, m/(half the mean mass by S)). Nodes beyond a mirror have no mass."""
    seen, found = seen_from(model, crack, k, point, up), []
    for node, S in point_2d(point, model.grid):
        key = (node, model.crossings(seen, model.grid.position(node))[0])
        if key in model.m and S > 0:
            found.append((S, key))
    if not found:
        return None
    light = 0.5 * sum(S * model.m[key] for S, key in found) / sum(S for S, _ in found)
    weights = [S * min(1.0, model.m[key] / light) for S, key in found]
    return tuple(sum(w * model.p[key][c] / model.m[key] for w, (_, key) in zip(weights, found)) / sum(weights) for c in range(2))


def keep_sides(crack):
    """Surface points of faces that can touch do not stay beyond the plane between them (fracture.md 6.4, no plane crossing)."""
    for k, x in enumerate(crack.plane):
        n = vertex_normal(crack.plane, k)
        for points, side in ((crack.upper, 1), (crack.lower, -1)):
            beyond = side * sum((points[k][c] - x[c]) * n[c] for c in range(2))
            if beyond > 0:
                points[k] = tuple(points[k][c] - side * beyond * n[c] for c in range(2))


def fill(velocities):
    """Vertices without a massive node go with the nearest vertex that has one (CONVENTIONS 39)."""
    known = [k for k, v in enumerate(velocities) if v is not None]
    if not known:
        return [(0.0, 0.0)] * len(velocities)
    return [v if v is not None else velocities[min(known, key=lambda j: abs(j - k))] for k, v in enumerate(velocities)]
