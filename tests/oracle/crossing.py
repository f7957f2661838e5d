"""Does the line from a particle to a node cross a crack? The rules of docs/theory/crossing.md in exact rational arithmetic.

Points are pairs of floats; every float is a rational number, so the signs below carry no rounding at all.
"""
import math
from fractions import Fraction
from functools import lru_cache


@lru_cache(maxsize=200000)
def exact(value):
    return Fraction(value)


def sign(value):
    return (value > 0) - (value < 0)


def orient(a, b, c):
    """(b - a) x (c - a): positive when c is left of a -> b."""
    ax, ay = exact(a[0]), exact(a[1])
    return (exact(b[0]) - ax) * (exact(c[1]) - ay) - (exact(b[1]) - ay) * (exact(c[0]) - ax)


def outside(p, n, a, b):
    """The rectangle of p, n and that of a, b do not touch: no crossing (N03 Appendix A, Subtask 1)."""
    return (max(p[0], n[0]) < min(a[0], b[0]) or max(a[0], b[0]) < min(p[0], n[0]) or
            max(p[1], n[1]) < min(a[1], b[1]) or max(a[1], b[1]) < min(p[1], n[1]))


def crosses_segment(p, n, a, b, tip_a, tip_b):
    """0: not crossed; +1: p above (left of) a -> b; -1: p below. The node is n + (e, e^2), e infinitesimal."""
    if outside(p, n, a, b):
        return 0
    to_a, to_b = orient(p, n, a), orient(p, n, b)
    if (tip_a and to_a == 0) or (tip_b and to_b == 0):  # tip tie rule: touching a tip is not a crossing
        return 0
    # orient(p, n, c) grows with n_x as c_y - p_y, with n_y as -(c_x - p_x)
    side_a = sign(to_a) or sign(a[1] - p[1]) or sign(p[0] - a[0])
    side_b = sign(to_b) or sign(b[1] - p[1]) or sign(p[0] - b[0])
    particle = sign(orient(a, b, p)) or 1  # a particle on the crack counts as above
    # orient(a, b, n) grows with n_x as -(b_y - a_y), with n_y as b_x - a_x
    node = sign(orient(a, b, n)) or sign(a[1] - b[1]) or sign(b[0] - a[0])
    return particle if side_a != side_b and particle != node else 0


def crosses_crack(p, n, vertices):
    """(side, crossed segments): side is +1 above, -1 below, 0 when the number of crossed segments is even.

    side = sign(#above - #below) over an odd number of crossed segments (conventions 17).
    """
    last = len(vertices) - 2
    above_minus_below, segments = 0, []
    for k in range(len(vertices) - 1):
        crossed = crosses_segment(p, n, vertices[k], vertices[k + 1], k == 0, k == last)
        if crossed:
            above_minus_below += crossed
            segments.append(k)
    if len(segments) % 2 == 0:
        return 0, []
    return sign(above_minus_below), segments


def segments_met(p, n, vertices, k):
    """The crossed segment k, and its neighbour when the line goes through the vertex between them (k again when it does not)."""
    last, other = len(vertices) - 2, k
    if k > 0 and orient(p, n, vertices[k]) == 0:
        other = k - 1
    if k < last and orient(p, n, vertices[k + 1]) == 0:
        other = k + 1
    return k, other


def segment_normal(vertices, k):
    """Unit normal (dy, -dx)/L from above to below of segment k."""
    dx = vertices[k + 1][0] - vertices[k][0]
    dy = vertices[k + 1][1] - vertices[k][1]
    length = math.hypot(dx, dy)
    return dy / length, -dx / length
