"""Contact across cracks at one node: the papers' literal scheme and the consistent one (docs/theory/contact.md, the scheme).

Fields joined by bonded cracks form one group with the common centre-of-mass velocity, as if the bonded cracks were not
there (conventions 13, 14, 44). A pair is two groups whose signatures differ by one crack, or by several with no group between; a is above, b below,
n points from a to b, w = v_b - v_a. The impulse J acts as +J on b and -J on a: equal and opposite.
"""
import math

OPEN, SLIP, STICK = "open", "slip", "stick"
STRICTNESS = ["none", "frictionless", "coulomb", "stick", "bonded"]  # ascending
SWEEPS = 10000  # the fixed point: light fields between heavy ones need some hundreds


class Pair:
    def __init__(self, a, b, crack, normal, gap, key):
        self.a, self.b, self.crack = a, b, crack  # signatures of the groups; Crack
        self.n = normal
        self.gap = gap  # at the start of the step, None: not known (volume)
        self.key = key  # (node, cracks between the two, other cracks between the pair and the node)
        self.previous = OPEN  # consistent scheme: Task-4 state of the last step
        self.state = OPEN
        # Normal velocity after the pair's own impulse as it was applied (docs/theory/contact.md, the scheme), in
        # this task and kept from Task 4. Of pairs done one after another the text does not say whether later ones count: no.
        self.w_after = self.w_end = 0.0
        self.J = (0.0, 0.0)


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1]


def field_number(signature):
    """N13's [0], [1], [2], [3] and on: bit k for the crack with the k-th id."""
    return sum(1 << crack for crack in signature)


def friction(pair, stick_t, normal_impulse):
    """Tangential impulse of the law: the one that sticks, cut to the friction cone (docs/theory/contact.md, impulses). Returns (J_t, state)."""
    law = pair.crack.law
    if law == "stick":
        return stick_t, STICK
    if law == "frictionless" or pair.crack.friction == 0:
        return (0.0, 0.0), SLIP
    size, limit = math.hypot(*stick_t), pair.crack.friction * abs(normal_impulse)
    if size <= limit:
        return stick_t, STICK
    return (stick_t[0] * limit / size, stick_t[1] * limit / size), SLIP


def impulse(pair, m_red, w, J_n, closing):
    """J = closing impulse J_n (positive resists approach) along n and the law's tangential part."""
    w_n = dot(w, pair.n)
    stick_t = (-m_red * (w[0] - w_n * pair.n[0]), -m_red * (w[1] - w_n * pair.n[1]))
    J_t, state = friction(pair, stick_t, J_n) if closing is None else closing(stick_t)
    return (J_n * pair.n[0] + J_t[0], J_n * pair.n[1] + J_t[1]), state


def literal_rule(model, dt, relative_volume):
    """Contact found anew in each task from the velocities of that task (N03 sec. 2.2; docs/theory/contact.md, detection)."""
    contact = model.contact

    def rule(pair, m_red, w):
        w_n = dot(w, pair.n)
        if contact["detection"] == "volume":
            if relative_volume < contact["volume_separated"]:
                active = False
            elif relative_volume > contact["volume_contact"] and not contact["require_approach"]:
                active = w_n != 0
            else:
                active = w_n < 0
        else:
            active = w_n < 0 and pair.gap + w_n * dt < 0
        if not active:
            return (0.0, 0.0)
        return impulse(pair, m_red, w, -m_red * w_n, None)[0]

    return rule


def bound(pair, model, dt, relative_volume):
    """Largest closing speed that is still free, -max(g, 0)/dt, with g <= 0 after a step in contact (hysteresis)."""
    if pair.previous != OPEN:
        return 0.0
    if pair.gap is None:  # by volume: no gap is known; separated below V_sep, touching above
        return -math.inf if relative_volume < model.contact["volume_separated"] else 0.0
    return -max(pair.gap, 0.0) / dt


def consistent_rule(task, model, dt, relative_volume):
    def by_test(pair, m_red, w):
        limit = bound(pair, model, dt, relative_volume)
        w_n = dot(w, pair.n)
        if not w_n < limit:
            if task == 4:
                pair.state = OPEN
            return (0.0, 0.0)
        J, state = impulse(pair, m_red, w, m_red * (limit - w_n), None)
        if task == 4:
            pair.state = state
        return J

    def bilateral(pair, m_red, w, target, stuck):
        J_n = m_red * (target - dot(w, pair.n))
        return impulse(pair, m_red, w, J_n, lambda stick_t: (stick_t if stuck else (0.0, 0.0), None))[0]

    def rule(pair, m_red, w):
        if task == 2 and pair.previous != OPEN:
            return bilateral(pair, m_red, w, 0.0, pair.previous == STICK)
        if task == 6:
            if pair.state == OPEN:
                return (0.0, 0.0)
            low = min(pair.w_end, 0.0)
            return bilateral(pair, m_red, w, min(0.0, max(dot(w, pair.n), low)), pair.state == STICK)
        return by_test(pair, m_red, w)

    return rule


def bonded_always(rule):
    """Bonded pairs, where they are pairs at all: the full stick impulse in every task, no detection (conventions 44)."""
    return lambda pair, m_red, w: (-m_red * w[0], -m_red * w[1]) if pair.crack.law == "bonded" else rule(pair, m_red, w)


def solve_node(groups, pairs, rule, free, joint=True):
    """Impulses of all pairs of a node, together or (joint false) each once, one after another.

    groups {signature: [mass, [vx, vy]]}; the velocities are changed. free: (1 or 0, 1 or 0), components that may change.
    Each pair sees the velocities without its own impulse; sweeps over the pairs until nothing moves but by round-off.
    """
    scale = max(max(abs(v[0]), abs(v[1])) for _, v in groups.values())
    for pair in pairs:
        pair.J = (0.0, 0.0)
    for sweep in range(SWEEPS if joint else 1):
        change = 0.0
        for pair in pairs:
            m_a, v_a = groups[pair.a]
            m_b, v_b = groups[pair.b]
            inverse = 1 / m_a + 1 / m_b
            w = [v_b[k] - v_a[k] - pair.J[k] * inverse for k in range(2)]
            J = rule(pair, m_a * m_b / (m_a + m_b), w)
            J = (J[0] * free[0], J[1] * free[1])
            for k in range(2):
                dJ = J[k] - pair.J[k]
                v_b[k] += dJ / m_b
                v_a[k] -= dJ / m_a
                change = max(change, abs(dJ) * inverse)
            pair.J = J
            if pair.n is not None:
                pair.w_after = dot([v_b[k] - v_a[k] for k in range(2)], pair.n)
        # Velocities of light fields keep trembling by the round-off of the heavy ones' momenta.
        if len(pairs) == 1 or not joint or change <= (1e-15 if sweep < 1000 else 1e-12) * scale:
            return sweep + 1
    raise RuntimeError("contact sweeps did not converge: change %g of %g" % (change, scale))
