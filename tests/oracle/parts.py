"""What a case is made of: grid, cracks, particles, symmetry planes, prescribed functions. SI throughout."""
import math

from crossing import crosses_segment
from materials import LAWS


def function(value):
    """Constant or expression of t, x, y -> callable."""
    if isinstance(value, str):
        code = compile(value.replace("^", "**"), value, "eval")
        names = {"sin": math.sin, "cos": math.cos, "exp": math.exp, "sqrt": math.sqrt, "pi": math.pi, "min": min, "max": max}
        return lambda t, x=0.0, y=0.0: eval(code, {"__builtins__": {}}, dict(names, t=t, x=x, y=y))
    return lambda t, x=0.0, y=0.0: value


class Grid:
    def __init__(self, spec):
        self.x0, self.y0 = spec["origin"]
        self.h = spec["cell"]

    def position(self, node):
        return self.x0 + node[0] * self.h, self.y0 + node[1] * self.h


class Crack:
    def __init__(self, index, spec):
        self.index = index
        self.law = spec["law"]
        self.friction = spec.get("friction", 0.0)
        self.fixed = spec.get("fixed", False)
        self.plane = [tuple(map(float, v)) for v in spec["points"]]
        self.extension = (0.0, 0.0)  # beyond ends that are no tips (crack_motion.py)
        self.original = list(self.plane)
        self.upper = list(self.plane)
        self.lower = list(self.plane)

    def path(self, vertices):
        """With what the crack cuts beyond its ends."""
        out = list(vertices)
        for end, before, length in ((0, 1, self.extension[0]), (-1, -2, self.extension[1])):
            if length > 0:
                a, b = vertices[end], vertices[before]
                L = math.hypot(a[0] - b[0], a[1] - b[1])
                x = tuple(a[k] + (a[k] - b[k]) / L * length for k in range(2))
                out = [x] + out if end == 0 else out + [x]
        return out


class Particle:
    def __init__(self, row, body, material, analysis):
        self.x = [row[0], row[1]]
        self.X = (row[0], row[1])
        self.volume = row[2]  # m3: area times thickness
        self.v = [row[3], row[4]]
        self.moved_with = list(self.v)
        self.mass = material["density"] * row[2]
        self.thickness = body.get("thickness", 1.0)
        self.material = LAWS[material["law"]](material, analysis)
        self.load = []  # force functions
        self.pairs = []

    def present(self, lead):
        """Position at the present time, which the one that the step works with leads: taken back by the velocity with which it moved last."""
        return [self.x[k] - lead * self.moved_with[k] for k in range(2)]

    def area(self):
        return self.material.area_ratio() * self.volume / self.thickness


class Symmetry:
    """A mirror: axis 0 or 1 is its normal, the body lies on `side`; part [low, high] of the other coordinate."""

    def __init__(self, spec, grid):
        self.axis, self.at, self.side = spec["axis"], spec["at"], spec.get("side", 1)
        self.low, self.high = spec.get("low", -math.inf), spec.get("high", math.inf)
        self.slack = 1e-9 * grid.h
        self.line = round((self.at - (grid.x0, grid.y0)[self.axis]) / grid.h)
        # the rest of the plane, as cracks whose tips are the ends of the part: touching an end is still meeting the part
        far = 1e6 * grid.h
        self.rest = []
        for end, sign in ((self.low, -1), (self.high, 1)):
            if math.isfinite(end):
                away = end + sign * far
                self.rest.append((self.point(end), self.point(away)))

    def point(self, other):
        return (self.at, other) if self.axis == 0 else (other, self.at)

    def distance(self, x):
        return self.side * (x[self.axis] - self.at)

    def holds(self, x):
        return abs(self.distance(x)) <= self.slack and self.low - self.slack <= x[1 - self.axis] <= self.high + self.slack

    def folds(self, p, n):
        """Does the line from p to a node n beyond the plane meet the part? (conventions 29)"""
        if self.distance(n) >= -self.slack or self.distance(p) < 0:
            return False
        return not any(crosses_segment(p, n, a, b, True, False) for a, b in self.rest)

    def mirror(self, node):
        i = 2 * self.line - node[self.axis]
        return (i, node[1]) if self.axis == 0 else (node[0], i)
