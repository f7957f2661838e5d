"""Shape functions of docs/theory/kinematics.md (shape functions), one direction at a time; the plane is the tensor product.

Each function returns [(node index, S, dS/dx)] for a point at x on the grid x0 + i h, zero values left out.
"""
import math


def linear(x, x0, h, half_size):
    """N = 1 - |xi| on the two nodes of the cell floor((x - x0)/h).

    A point exactly on a grid line is taken as just inside one cell (conventions 38), so that no force meets a zero mass.
    """
    cell = math.floor((x - x0) / h)
    fraction = min(max((x - x0) / h - cell, 1e-12), 1 - 1e-12)
    return [(cell, 1 - fraction, -1 / h), (cell + 1, fraction, 1 / h)]


def gimp(x, x0, h, half_size):
    """uGIMP with the undeformed half size l = 1/(2 particles per cell), in cells."""
    l = half_size
    result = []
    centre = math.floor((x - x0) / h)
    for i in range(centre - 1, centre + 3):
        xi = (x - x0) / h - i
        a = abs(xi)
        sign = 1.0 if xi > 0 else -1.0
        if a < l:
            s, g = 1 - (xi * xi + l * l) / (2 * l), -xi / (l * h)
        elif a < 1 - l:
            s, g = 1 - a, -sign / h
        elif a < 1 + l:
            s, g = (1 + l - a) ** 2 / (4 * l), -sign * (1 + l - a) / (2 * l * h)
        else:
            continue
        if s > 0:
            result.append((i, s, g))
    return result


def bspline(x, x0, h, half_size):
    """Quadratic B-spline."""
    result = []
    centre = math.floor((x - x0) / h)
    for i in range(centre - 1, centre + 3):
        xi = (x - x0) / h - i
        a = abs(xi)
        sign = 1.0 if xi > 0 else -1.0
        if a < 0.5:
            s, g = 0.75 - xi * xi, -2 * xi / h
        elif a < 1.5:
            s, g = 0.5 * (1.5 - a) ** 2, -sign * (1.5 - a) / h
        else:
            continue
        if s > 0:
            result.append((i, s, g))
    return result


def cubic_bspline(x, x0, h, half_size):
    """Cubic B-spline with knots at the nodes."""
    result = []
    centre = math.floor((x - x0) / h)
    for i in range(centre - 1, centre + 3):
        xi = (x - x0) / h - i
        a = abs(xi)
        sign = 1.0 if xi > 0 else -1.0
        if a < 1:
            s, g = 2 / 3 - a ** 2 + a ** 3 / 2, sign * (1.5 * a ** 2 - 2 * a) / h
        elif a < 2:
            s, g = (2 - a) ** 3 / 6, -sign * (2 - a) ** 2 / (2 * h)
        else:
            continue
        if s > 0:
            result.append((i, s, g))
    return result


SHAPES = {"linear": linear, "gimp": gimp, "bspline": bspline, "cubic_bspline": cubic_bspline}


def shape_2d(kind, x, y, grid, half_size):
    """[((i, j), S, (Gx, Gy))] for a point (N03 Eq. 24)."""
    one = SHAPES[kind]
    along_x = one(x, grid.x0, grid.h, half_size)
    along_y = one(y, grid.y0, grid.h, half_size)
    return [((i, j), sx * sy, (gx * sy, sx * gy)) for j, sy, gy in along_y for i, sx, gx in along_x]


def cpdi_2d(x, y, grid, edges):
    """The same for a domain with the half edges edges[0] and edges[1] in cells: S is the mean of the linear functions at its corners, G the gradient
    of what is linear in it and has their values there. Extents of more than half a cell to either side count as half a cell.
    """
    longest = [abs(edges[0][k]) + abs(edges[1][k]) for k in range(2)]
    a, b = ([e[k] * 0.5 / max(0.5, longest[k]) for k in range(2)] for e in edges)
    area = a[0] * b[1] - a[1] * b[0]
    along_a, along_b = (b[1] / area, -b[0] / area), (-a[1] / area, a[0] / area)  # along_a.a = 1, along_a.b = 0 and so on
    sums = {}
    for s in (-1, 1):
        for t in (-1, 1):
            place = [(x - grid.x0) / grid.h + s * a[0] + t * b[0], (y - grid.y0) / grid.h + s * a[1] + t * b[1]]
            place = [round(q) if abs(q - round(q)) < 1e-12 else q for q in place]  # no mass that is none
            for i in (math.floor(place[0]), math.floor(place[0]) + 1):
                for j in (math.floor(place[1]), math.floor(place[1]) + 1):
                    N = (1 - abs(place[0] - i)) * (1 - abs(place[1] - j))
                    of = sums.setdefault((i, j), [0.0, 0.0, 0.0])
                    of[0] += N / 4
                    for k in range(2):
                        of[1 + k] += N * (s * along_a[k] + t * along_b[k]) / (4 * grid.h)
    return [(node, S, (gx, gy)) for node, (S, gx, gy) in sums.items() if S > 0]


def point_2d(x, grid):
    """[((i, j), S)] of a point without a size, a crack vertex: linear, and exactly on a grid line only the nodes of that line."""
    one = []
    for k, start in enumerate((grid.x0, grid.y0)):
        cell = math.floor((x[k] - start) / grid.h)
        fraction = (x[k] - start) / grid.h - cell
        one.append([(cell, 1 - fraction), (cell + 1, fraction)])
    return [((i, j), sx * sy) for j, sy in one[1] for i, sx in one[0] if sx * sy > 0]
