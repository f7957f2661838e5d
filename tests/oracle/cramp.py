"""A plain, slow implementation of N03 (Appendix A) and N13 in two dimensions: the oracle for the engine.

Loops over particles and nodes; nodal quantities live in dictionaries keyed by (node, frozenset of crossed cracks).
Mass, fields, normals, volumes and shape functions belong to the positions at the start of the step.
SI throughout. A case is a dictionary; see cases.py.
"""
import math
from types import SimpleNamespace

import contact as ct
from crack_motion import carry_cracks, choose_carriers, extend, move_cracks
from crossing import crosses_crack, segment_normal, segments_met
from parts import Crack, Grid, Particle, Symmetry, function
from shapes import cpdi_2d, shape_2d


class Model:
    def __init__(self, case):
        self.case = case
        analysis = case.get("analysis", "plane_strain")
        self.grid = Grid(case["grid"])
        self.dt = case["dt"]
        self.t = 0.0
        self.k = 0
        self.lead = 0.0  # s: positions of particles and crack points are those of the present time plus this
        self.update = case.get("stress_update", "usavg")
        self.positions = case.get("positions", "strain")
        self.rotation = case.get("rotation", "carried")
        self.shape = case.get("shape", "linear")
        self.half_size = 1 / (2 * case.get("ppc", 2))
        self.damping = function(case.get("damping", 0.0))
        self.body_force = [function(b) for b in case.get("body_force", (0.0, 0.0))]
        self.order = case.get("order", "contact_first")
        self.fixed_force = case.get("fixed_force", "incremental")
        self.contact = dict({"scheme": "consistent", "detection": "displacement", "pairs": "joint", "volume_separated": 0.9,
                             "volume_contact": 1.1, "require_approach": True, "reference_volume": "cell", "mass_screen": 1e-6}, **case.get("contact", {}))
        self.particles = [Particle(row, body, case["materials"][body["material"]], analysis)
                          for body in case["bodies"] for row in body["particles"]]
        for p in self.particles:
            p.edges = [[self.half_size, 0.0], [0.0, self.half_size]]  # of its domain, in cells, where it stretches
        self.cracks = [Crack(i, c) for i, c in enumerate(case.get("cracks", []))]
        self.joined = frozenset(c.index for c in self.cracks if c.law == "bonded" and self.contact["pairs"] == "joint")
        self.symmetries = [Symmetry(s, self.grid) for s in case.get("symmetries", [])]
        self.boundaries = [dict(b, value=[None if b.get(c) is None else function(b[c]) for c in ("vx", "vy")],
                                start=b.get("start", 0.0), end=b.get("end", math.inf)) for b in case.get("boundaries", [])]
        for load in case.get("loads", []):
            chosen = [p for p in self.particles if all(load["low"][k] <= p.X[k] <= load["high"][k] for k in range(2))]
            share = 1 / len(chosen) if load["kind"] == "total_force" else 1.0
            for p in chosen:
                p.load.append((share, [function(f) for f in load["value"]]))
        extend(self)
        self.find_pieces()
        choose_carriers(self)
        self.contact_state = {}  # (node, crack, others): Task-4 state of the last step
        self.crack_side = {}     # (node, crack): side of the particles that look at the node across the crack
        self.reference_volume = None  # by node, of all particles at t = 0

    # ---------------------------------------------------------------- one step, N03 Appendix A in the order of N13
    def step(self):
        dt = self.dt
        # Positions lead velocities by half a step, so that forces find them in its middle; not with N03 Eq. 30.
        further = (dt / 2 if self.positions == "strain" else 0.0) - self.lead
        if further:
            self.lead += further
            for p in self.particles:
                p.x = [p.x[k] + further * p.v[k] for k in range(2)]
            carry_cracks(self)
        self.assign_fields()                                   # Task 0
        self.find_turns()
        self.project_momentum()                                # Task 1
        if self.order == "boundary_first":                     # Task 2
            self.p_int = {key: list(p) for key, p in self.p.items()}
            self.impose_velocity(self.t, task=2)
            self.adjust_contact(2)
        else:
            self.adjust_contact(2)
            self.p_int = {key: list(p) for key, p in self.p.items()}
            self.impose_velocity(self.t, task=2)
        if self.update == "usf":
            self.update_stress(dt - further, end=False)
        elif self.update == "usavg":
            self.update_stress(dt / 2, end=False)
        self.project_forces()                                  # Task 3
        self.impose_forces()
        for key, p in self.p.items():                          # Task 4, N03 Eq. 29
            for k in range(2):
                if self.fixed_force == "n13" and k in self.fixed.get(key[0], {}):
                    p[k] = self.p_int[key][k]                  # N13 Eq. 2 starts from p_int (conventions 27)
                p[k] += dt * self.f[key][k]
        self.adjust_contact(4)
        self.answer_turns()
        moved = self.update_particles()                        # Task 5
        if self.update in ("musl", "usavg") or (self.update == "usf" and self.positions == "strain"):  # Task 6
            self.project_new_momentum()
            if self.order == "boundary_first":
                self.impose_velocity(self.t + dt, task=6)
                self.adjust_contact(6)
            else:
                self.adjust_contact(6)
                self.impose_velocity(self.t + dt, task=6)
        if self.positions == "strain":                         # USL: the velocity of Task 4 is the one that strains
            moved = self.moved_positions()
        if self.update in ("usl", "musl"):
            self.update_stress(dt + further)
        elif self.update == "usavg":
            self.update_stress(dt / 2)
        if self.shape == "cpdi":
            self.stretch_domains(dt + further)
        self.store_contact_state()
        for p, x in zip(self.particles, moved):
            p.moved_with = [(x[k] - p.x[k]) / dt for k in range(2)]
            # What was led on before the step by the particle's own velocity is to have been led by this one.
            p.x = [x[k] + further * (p.moved_with[k] - p.v[k]) for k in range(2)]
        move_cracks(self)                                      # Task 8 of N13
        self.k += 1
        self.t = self.k * dt

    # ---------------------------------------------------------------- Tasks 0, 1
    def crossings(self, point, node_position):
        """Signature of the line from a point to a node, and (crack, side, segments) of each crack it crosses."""
        found = []
        for crack in self.cracks:
            side, segments = crosses_crack(tuple(point), node_position, crack.path(crack.plane))
            if side:
                found.append((crack, side, segments))
        return frozenset(c.index for c, _, _ in found), found

    def fold(self, point, node):
        """Mirror a node beyond a symmetry plane: (node, signs of the components, fold of positions)."""
        signs, planes = [1, 1], []
        position = self.grid.position(node)
        for s in self.symmetries:
            if s.folds(tuple(point), position):
                node = s.mirror(node)
                signs[s.axis] = -1
                planes.append(s)
        return node, signs, planes

    def fold_at_held_faces(self, point, node, R, planes):
        """Wide functions see nodes beyond a face of prescribed velocity: v_beyond = 2 V - v_mirror for what the face's node holds.

        The face is the row of nodes between, when it holds the component across; beside its last node it goes on for points that are before
        the row itself (a row seen edge-on is no face). Between two held nodes there is nothing to fold. Returns the mirror node, signs, mirrors, and what to add to the
        velocities at the start and the end of the step.
        """
        offset = [[0.0, 0.0], [0.0, 0.0]]
        if self.shape == "linear":
            return node, R, planes, offset
        R, planes = list(R), list(planes)

        def neighbour(n, axis, by):
            return (n[0] + by, n[1]) if axis == 0 else (n[0], n[1] + by)

        for axis in range(2):
            if axis in {s.axis for s in planes}:
                continue
            up = 1 if point[axis] > self.grid.position(node)[axis] else -1
            face = neighbour(node, axis, up)
            at = self.grid.position(face)[axis]
            if up * (point[axis] - at) < 0 or (up < 0 and point[axis] == at):
                continue
            mirror = neighbour(face, axis, up)
            if axis in self.held_velocities(node) and axis in self.held_velocities(mirror):
                continue
            velocities = self.held_velocities(face)
            if axis not in velocities:
                along = 1 - axis
                to = 1 if point[along] > self.grid.position(face)[along] else -1
                last = neighbour(face, along, to)
                velocities = self.held_velocities(last)
                if axis not in velocities or axis not in self.held_velocities(neighbour(last, along, to)) or to * (point[along] - self.grid.position(last)[along]) < 0:
                    continue
            node = mirror
            planes.append(SimpleNamespace(axis=axis, at=at))
            for k, values in velocities.items():
                for when in range(2):
                    offset[when][k] += 2 * R[k] * values[when]
                R[k] = -R[k]
        return node, R, planes, offset

    def held_velocities(self, node):
        """Per prescribed component the velocity at the start and the end of the step; none in the first step, when the body still moves."""
        if node not in self.held_faces:
            x, found = self.grid.position(node), {}
            for k, (value, earlier) in self.prescribed(node).items():
                if earlier is None and self.fixed_force == "incremental":
                    continue
                found[k] = ((earlier or value)(self.t, *x), value(self.t + self.dt, *x))
            self.held_faces[node] = found
        return self.held_faces[node]

    def assign_fields(self):
        """v(p, i) of N03 Eq. 2 as the set of cracks crossed; crack normals at nodes over crossed pairs (conventions 9)."""
        normal, original, side_sum = {}, {}, {}
        self.held_faces = {}
        for p in self.particles:
            p.pairs = []
            if self.shape == "cpdi":
                pairs = cpdi_2d(p.x[0], p.x[1], self.grid, p.edges)
            else:
                pairs = shape_2d(self.shape, p.x[0], p.x[1], self.grid, self.half_size)
            for node, S, G in pairs:
                target, R, planes = self.fold(p.x, node)
                folded = self.fold_at_held_faces(p.x, target, R, planes)
                # the image of a crack is known behind a symmetry plane only: else the line goes to the mirror node
                end = node if folded[0] == target else folded[0]
                end = self.grid.position(end)
                signature, found = self.crossings(p.x, end)
                target, flips, mirrors, offset = folded
                p.pairs.append(((target, signature), S, G, flips, mirrors, offset))
                for crack, side, segments in found:
                    key = (target, crack.index)
                    n, N = normal.setdefault(key, [0.0, 0.0]), original.setdefault(key, [0.0, 0.0])
                    met = [s for k in segments for s in segments_met(tuple(p.x), end, crack.path(crack.plane), k)]
                    for k in met:  # twice each, or with the neighbour at a vertex
                        now, then = segment_normal(crack.path(crack.plane), k), segment_normal(crack.path(crack.original), k)
                        for c in range(2):
                            n[c] += 0.5 * R[c] * now[c]
                            N[c] += 0.5 * R[c] * then[c]
                    side_sum[key] = side_sum.get(key, 0) + side
        self.side = {key: 1 if s >= 0 else -1 for key, s in side_sum.items()}
        self.normal = {key: self.unit_normal(key[0], n) for key, n in normal.items()}
        self.original_normal = {key: self.unit_normal(key[0], n) for key, n in original.items()}

    def unit_normal(self, node, n):
        """On a symmetry plane without the component along the plane's normal (docs/theory/contact.md, normals). None: nothing is left."""
        across = {s.axis for s in self.symmetries if s.holds(self.grid.position(node))}
        n = [0.0 if k in across else c for k, c in enumerate(n)]
        length = math.hypot(*n)
        return [c / length for c in n] if length > 1e-9 else None  # a sum of unit vectors: less is rounding

    def project_momentum(self):
        """N03 Eqs. 26, 27, and mean positions per field (docs/theory/step.md, detection)."""
        self.m, self.p, self.volume = {}, {}, {}
        self.x_sum, self.X_sum = {}, {}
        self.first_moment, self.pieces_at = {}, {}
        for p in self.particles:
            area = p.area()
            for key, S, G, R, planes, offset in p.pairs:
                m = p.mass * S
                self.m[key] = self.m.get(key, 0.0) + m
                momentum = self.p.setdefault(key, [0.0, 0.0])
                now, then = self.x_sum.setdefault(key, [0.0, 0.0]), self.X_sum.setdefault(key, [0.0, 0.0])
                x, X = list(p.x), list(p.X)
                for s in planes:
                    x[s.axis], X[s.axis] = 2 * s.at - x[s.axis], 2 * s.at - X[s.axis]
                for k in range(2):
                    momentum[k] += R[k] * m * (p.v[k] - offset[0][k])
                    now[k] += m * x[k]
                    then[k] += m * X[k]
                across, node = {s.axis for s in planes}, self.grid.position(key[0])
                d = self.first_moment.setdefault(key, [0.0, 0.0])
                if S != 0:
                    self.pieces_at.setdefault(key, {})[id(p.piece)] = p.piece
                for k in range(2):  # no arm across a plane at which the pair is folded
                    d[k] += m * (node[k] if k in across else p.x[k])
                self.volume[key[0]] = self.volume.get(key[0], 0.0) + area * S
        if self.reference_volume is None:
            self.reference_volume = dict(self.volume)
        self.add_turns("turn", -self.lead)
        self.find_constraints()
        self.zero_on_planes(self.p)
        self.find_pairs()

    # ---------------------------------------------------------------- rotation carried (docs/decisions/0020-rotation.md)
    def find_pieces(self):
        """Particles hang together in the same or in neighbouring cells when no crack but a bonded one lies between. A mirror at a piece holds it."""
        cells = [tuple(math.floor((p.x[k] - (self.grid.x0, self.grid.y0)[k]) / self.grid.h) for k in range(2)) for p in self.particles]
        parting = [c for c in self.cracks if c.law != "bonded"]
        for p in self.particles:
            p.piece = None
        self.pieces = []
        for first in range(len(self.particles)):
            if self.particles[first].piece:
                continue
            piece = SimpleNamespace(particles=[], held=False)
            self.pieces.append(piece)
            reached = [first]
            self.particles[first].piece = piece
            while reached:
                i = reached.pop()
                p = self.particles[i]
                piece.particles.append(p)
                piece.held |= any(abs(s.distance(p.x)) < 1.5 * self.half_size * self.grid.h for s in self.symmetries)
                for j, q in enumerate(self.particles):
                    if q.piece or max(abs(cells[i][k] - cells[j][k]) for k in range(2)) > 1:
                        continue
                    if not any(crosses_crack(tuple(p.x), tuple(q.x), c.path(c.plane))[0] for c in parting):
                        q.piece = piece
                        reached.append(j)

    def find_turns(self):
        """Of every piece as if it were rigid: centre, moment of inertia, angular velocity."""
        for piece in self.pieces:
            piece.grasped = any(s not in self.symmetries for p in piece.particles for pair in p.pairs for s in pair[4])
            M = sum(p.mass for p in piece.particles)
            piece.centre = [sum(p.mass * p.x[k] for p in piece.particles) / M for k in range(2)]
            v = [sum(p.mass * p.v[k] for p in piece.particles) / M for k in range(2)]
            arms = [(p, p.x[0] - piece.centre[0], p.x[1] - piece.centre[1]) for p in piece.particles]
            piece.inertia = sum(p.mass * (x * x + y * y) for p, x, y in arms)
            piece.turns = self.rotation == "carried" and not piece.held and not piece.grasped and piece.inertia > 0
            if piece.turns:
                piece.turn = sum(p.mass * (x * (p.v[1] - v[1]) - y * (p.v[0] - v[0])) for p, x, y in arms) / piece.inertia
            piece.answer = 0.0  # rad/s2

    def turning(self, key):
        """The piece whose rotation a node has a part in: that of all its particles; none where they are of several."""
        pieces = list(self.pieces_at.get(key, {}).values())
        return pieces[0] if len(pieces) == 1 and pieces[0].turns else None

    def arm(self, key):
        """Sum of m_p S (x_i - x_p) over the particles about a node in its field."""
        x = self.grid.position(key[0])
        return [self.m[key] * x[k] - self.first_moment[key][k] for k in range(2)]

    def answer_turns(self):
        """What nodes have beside sum S m v does work; particles take it up as a rigid turn, so that energy and angular momentum are kept."""
        self.unseen = -math.expm1(-self.damping(self.t + self.lead) * self.dt) if self.positions == "strain" else 0.0
        for piece in self.pieces:
            piece.couple = piece.torque = piece.read = 0.0
        for key, f in self.f.items():
            piece = self.turning(key)
            if not piece:
                continue
            a = [f[k] / self.m[key] for k in range(2)]
            e = self.arm(key)
            piece.couple += e[0] * a[1] - e[1] * a[0]
            x = self.grid.position(key[0])
            r = [x[k] - piece.centre[k] for k in range(2)]
            piece.torque += r[0] * f[1] - r[1] * f[0]
            # Angular momentum of particles that take the velocities of nodes.
            piece.read += sum(s * (self.m[key] * r[k] - e[k]) * self.p[key][1 - k] / self.m[key] for k, s in ((0, 1), (1, -1)))
        for piece in self.pieces:
            if not piece.turns:
                continue
            piece.answer = piece.couple / piece.inertia
            own = 1 - self.unseen
            piece.turn_after = own * piece.turn + (self.unseen * piece.read + own * self.dt * piece.torque) / piece.inertia

    def add_turns(self, which, ahead):
        """Of velocities of a time that is ahead of the positions by so much: w x e + ahead w x (w x e)."""
        for key, p in self.p.items():
            piece = self.turning(key)
            if piece:
                e, turn = self.arm(key), getattr(piece, which)
                p[0] -= turn * e[1] + ahead * turn ** 2 * e[0]
                p[1] += turn * e[0] - ahead * turn ** 2 * e[1]

    def conditions(self, t):
        """Boundary conditions that a step starting at t belongs to."""
        return [b for b in self.boundaries if b["start"] <= t < b["end"]]

    def find_constraints(self):
        """Per node with mass: components held by a symmetry plane, and components with a prescribed velocity.

        Of several conditions the last stated holds. fresh: prescribed now, but by no condition in the step before; old: what was
        prescribed in the step before.
        """
        self.held, self.fixed, self.fresh, self.old = {}, {}, set(), {}
        for node in {key[0] for key in self.m}:
            x = self.grid.position(node)
            for s in self.symmetries:
                if s.holds(x):
                    self.held.setdefault(node, set()).add(s.axis)
            for k, (value, earlier) in self.prescribed(node).items():
                self.fixed.setdefault(node, {})[k] = value
                if earlier:
                    self.old[node, k] = earlier
                else:
                    self.fresh.add((node, k))

    def prescribed(self, node):
        """{component: (value, the value that the step before had or None)}. Of several conditions the last stated holds."""
        slack, x, found = 1e-9 * self.grid.h, self.grid.position(node), {}
        now, before = self.conditions(self.t), self.conditions((self.k - 1) * self.dt) if self.k else []
        here, there = ([b for b in conditions if all(b["low"][k] - slack <= x[k] <= b["high"][k] + slack for k in range(2))]
                       for conditions in (now, before))
        for k in range(2):
            values, earlier = ([b["value"][k] for b in boundaries if b["value"][k] is not None] for boundaries in (here, there))
            if values:
                found[k] = (values[-1], earlier[-1] if earlier else None)
        return found

    def zero_on_planes(self, field):
        for key, value in field.items():
            for k in self.held.get(key[0], ()):
                value[k] = 0.0

    # ---------------------------------------------------------------- contact
    def find_pairs(self):
        """Groups of fields joined by bonded cracks, and the pairs of groups that face each other, for every node.

        Done one after another (N13), bonded cracks make pairs like others. Order: by crack, then by what else lies between
        the pair and the node, as the number that N13 gives that field: [0][1], [2][3], then [0][2], [1][3] (conventions 13).
        """
        self.groups, self.node_pairs = {}, {}
        members = {}
        for node, signature in self.m:
            members.setdefault(node, {}).setdefault(signature - self.joined, []).append((node, signature))
        for node, groups in members.items():
            if sum(len(keys) for keys in groups.values()) < 2:
                continue
            self.groups[node] = groups
            mass = {s: sum(self.m[key] for key in keys) for s, keys in groups.items()}
            pairs = []
            for above, below, between in self.facing(node, groups):
                fraction = mass[above] / (mass[above] + mass[below])
                bonded = len(between) == 1 and between[0].law == "bonded"
                if bonded or min(fraction, 1 - fraction) >= self.contact["mass_screen"]:
                    pairs.append(self.make_pair(node, between, groups, above, below))
            self.node_pairs[node] = pairs

    def facing(self, node, groups):
        """(above, below, cracks between that act) for the groups of a node that no other lies between: its signature would differ from both
        by fewer cracks (conventions 50). Above and below the first of these cracks. One after another (N13): one crack alone.
        """
        found = []
        for i, g in enumerate(groups):
            for h in list(groups)[i + 1:]:
                apart = g ^ h
                if len(apart) > 1 and (self.contact["pairs"] != "joint" or any(len(g ^ s) < len(apart) > len(s ^ h) for s in groups)):
                    continue
                between = [self.cracks[c] for c in sorted(apart) if self.cracks[c].law != "none" and self.normal.get((node, c)) is not None]
                if not between:
                    continue
                first = between[0].index
                above, below = (g, h) if (first in g) == (self.side[node, first] > 0) else (h, g)
                found.append(((min(apart), ct.field_number(g & h), sorted(apart)), above, below, between))
        return [item[1:] for item in sorted(found, key=lambda item: item[0])]

    def make_pair(self, node, between, groups, above, below):
        """delta_n = (xbar_b - xbar_a).n - (Xbar_b - Xbar_a).N (docs/theory/step.md, detection) and the state of the last step. Of several cracks between the
        two the strictest law holds, and n is their mean.
        """
        crack = max(between, key=lambda c: (ct.STRICTNESS.index(c.law), c.friction if c.law == "coulomb" else 0, -c.index))
        others, apart = above & below, above ^ below

        def mean_normal(table):
            if len(between) == 1:
                return table[node, between[0].index]
            total = [0.0, 0.0]
            for c in between:
                sign = 1 if (c.index in above) == (self.side[node, c.index] > 0) else -1
                total = [total[k] + sign * table[node, c.index][k] for k in range(2)]
            return (total[0] / math.hypot(*total), total[1] / math.hypot(*total))

        n, N = mean_normal(self.normal), mean_normal(self.original_normal)

        def mean(table, keys):
            m = sum(self.m[key] for key in keys)
            return [sum(table[key][k] for key in keys) / m for k in range(2)]

        gap = None
        if self.contact["detection"] == "displacement" and crack.law != "bonded":
            x_a, x_b = mean(self.x_sum, groups[above]), mean(self.x_sum, groups[below])
            X_a, X_b = mean(self.X_sum, groups[above]), mean(self.X_sum, groups[below])
            gap = sum((x_b[k] - x_a[k]) * n[k] - (X_b[k] - X_a[k]) * N[k] for k in range(2))
        pair = ct.Pair(above, below, crack, n, gap, (node, apart, others))
        flipped = {d for d in range(len(self.cracks)) if d not in self.joined | apart and (node, d) in self.side and
                   self.crack_side.get((node, d), self.side[node, d]) != self.side[node, d]}
        pair.previous = self.contact_state.get((node, apart, others ^ flipped), ct.OPEN)
        return pair

    def adjust_contact(self, task):
        """Changes momenta; in Task 4 also the forces, f += dp/dt (N13 sec. 2.5)."""
        for node, groups in self.groups.items():
            state = {}
            for signature, keys in groups.items():
                mass = sum(self.m[key] for key in keys)
                state[signature] = [mass, [sum(self.p[key][k] for key in keys) / mass for k in range(2)]]
            before = {s: list(v) for s, (_, v) in state.items()}
            locked = set(self.held.get(node, ()))
            if task == 4 or self.order == "boundary_first":
                locked |= set(self.fixed.get(node, ()))
            free = [0 if k in locked else 1 for k in range(2)]
            pairs = self.node_pairs[node]
            if pairs:
                undeformed = self.grid.h ** 2 if self.contact["reference_volume"] == "cell" else self.reference_volume[node]
                if self.contact["scheme"] == "literal":
                    rule = ct.literal_rule(self, self.dt, self.volume[node] / undeformed)
                else:
                    rule = ct.consistent_rule(task, self, self.dt, self.volume[node] / undeformed)
                ct.solve_node(state, pairs, ct.bonded_always(rule), free, self.contact["pairs"] == "joint")
                if task == 4:
                    for pair in pairs:
                        pair.w_end = pair.w_after
            for signature, keys in groups.items():
                _, v = state[signature]
                for key in keys:
                    for k in range(2):
                        if len(keys) > 1:  # bonded: all at the common velocity
                            dp = free[k] * (self.m[key] * v[k] - self.p[key][k])
                        else:
                            dp = self.m[key] * (v[k] - before[signature][k])
                        self.p[key][k] += dp
                        if task == 4:
                            self.f[key][k] += dp / self.dt

    def store_contact_state(self):
        self.contact_state = {pair.key: pair.state for pairs in self.node_pairs.values() for pair in pairs if pair.state != ct.OPEN}
        self.crack_side = dict(self.side)

    # ---------------------------------------------------------------- boundary conditions
    def impose_velocity(self, t, task):
        """Momentum of prescribed components at time t, the time the momentum refers to (conventions 30).

        Incremental form: in the first step of a prescribed component the old velocity is p_int/m.
        """
        for key, p in self.p.items():
            for k, value in self.fixed.get(key[0], {}).items():
                if task == 2 and self.fixed_force == "incremental" and (key[0], k) in self.fresh:
                    continue
                prescribed = self.old.get((key[0], k), value) if task == 2 else value
                p[k] = self.m[key] * prescribed(t, *self.grid.position(key[0]))

    def impose_forces(self):
        self.zero_on_planes(self.f)
        for key, f in self.f.items():
            for k, value in self.fixed.get(key[0], {}).items():
                new = self.m[key] * value(self.t + self.dt, *self.grid.position(key[0]))
                if self.fixed_force == "incremental":      # f = m (V_new - V_old)/dt
                    f[k] = (new - self.p[key][k]) / self.dt
                elif self.fixed_force == "n13":            # N13 Eq. 1
                    f[k] = (new - self.p_int[key][k]) / self.dt
                else:                                      # N03 Task 3
                    f[k] = 0.0

    # ---------------------------------------------------------------- Tasks 3, 5, 6
    def project_forces(self):
        """N03 Eq. 28: internal, body and particle forces, damping of the momentum after Task 2."""
        self.f = {key: [0.0, 0.0] for key in self.m}
        middle = self.t + self.lead  # the time of positions
        b = [f(middle) for f in self.body_force]
        kappa = self.damping(middle)
        for p in self.particles:
            xx, yy, xy = (p.volume * s for s in p.material.force_stress())
            external = [p.mass * b[k] + sum(share * f[k](middle) for share, f in p.load) for k in range(2)]
            for key, S, G, R, _, offset in p.pairs:
                f = self.f[key]
                for k in range(2):  # on the image behind a face: what follows the face, and damping of its own velocity
                    rate = (offset[1][k] - offset[0][k]) / self.dt
                    f[k] -= R[k] * p.mass * S * (rate + kappa * offset[0][k])
                f[0] += R[0] * (-(xx * G[0] + xy * G[1]) + external[0] * S)
                f[1] += R[1] * (-(xy * G[0] + yy * G[1]) + external[1] * S)
        for key, f in self.f.items():
            for k in range(2):
                f[k] -= kappa * self.p[key][k]

    def update_particles(self):
        """N03 Eq. 30: velocities now, positions returned (they advance at the end of the step).

        Damping takes from a particle as much of what nodes do not see of its velocity as it takes from nodes.
        """
        for p in self.particles:
            for key, S, G, R, _, offset in p.pairs:
                for k in range(2):
                    p.v[k] += S * (self.dt * R[k] * self.f[key][k] / self.m[key] + offset[1][k] - offset[0][k])
            p.v[0] -= self.dt * p.piece.answer * (p.x[1] - p.piece.centre[1])
            p.v[1] += self.dt * p.piece.answer * (p.x[0] - p.piece.centre[0])
            for k in range(2):
                of_nodes = sum(S * (R[k] * self.p[key][k] / self.m[key] + offset[1][k]) for key, S, _, R, _, offset in p.pairs)
                p.v[k] += self.unseen * (of_nodes - p.v[k])
        return self.moved_positions()

    def moved_positions(self):
        """x + dt sum S v with the nodal velocities at hand, which are those of the end of the step."""
        return [[p.x[k] + self.dt * sum(S * (R[k] * self.p[key][k] / self.m[key] + offset[1][k]) for key, S, _, R, _, offset in p.pairs)
                 for k in range(2)] for p in self.particles]

    def project_new_momentum(self):
        """N03 Eq. 31."""
        self.p = {key: [0.0, 0.0] for key in self.m}
        for p in self.particles:
            for key, S, G, R, _, offset in p.pairs:
                for k in range(2):
                    self.p[key][k] += R[k] * p.mass * (p.v[k] - offset[1][k]) * S
        self.add_turns("turn_after", self.dt - self.lead)
        self.zero_on_planes(self.p)

    def gradient(self, p, end):
        """N03 Eq. 36: L = sum v (x) G with the velocities of the fields the particle belongs to, those of the end of the step or not."""
        L = [[0.0, 0.0], [0.0, 0.0]]
        for key, S, G, R, _, offset in p.pairs:
            for i in range(2):
                v = R[i] * self.p[key][i] / self.m[key] + offset[1 if end else 0][i]
                for j in range(2):
                    L[i][j] += v * G[j]
        return L

    def stretch_domains(self, dt):
        """Corners of domains move with the nodes, as positions do."""
        for p in self.particles:
            L = self.gradient(p, True)
            p.edges = [[e[i] + dt * (L[i][0] * e[0] + L[i][1] * e[1]) for i in range(2)] for e in p.edges]

    def update_stress(self, dt, end=True):
        """N03 Eqs. 34, 35."""
        for p in self.particles:
            L = self.gradient(p, end)
            if p.material.follows_deformation and self.positions == "strain":
                # Taken at the start of the particle's path (USL, MUSL) or at its end (USF); I + A + A^2/2 of the laws is right in its middle.
                ahead = {"usl": dt / 2, "musl": dt / 2, "usf": -dt / 2, "usavg": 0.0}[self.update]
                L = [[L[i][j] - ahead * (L[i][0] * L[0][j] + L[i][1] * L[1][j]) for j in range(2)] for i in range(2)]
            p.material.update(L, dt)

    # ---------------------------------------------------------------- what tests look at
    def momentum(self):
        return [sum(p.mass * p.v[k] for p in self.particles) for k in range(2)]

    def kinetic_energy(self):
        return sum(0.5 * p.mass * (p.v[0] ** 2 + p.v[1] ** 2) for p in self.particles)

    def strain_energy(self):
        return sum(p.volume * p.material.energy_density() for p in self.particles)


def run(case, steps=None):
    model = Model(case)
    for _ in range(case["steps"] if steps is None else steps):
        model.step()
    return model
