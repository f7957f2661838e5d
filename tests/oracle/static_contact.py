#!/usr/bin/env python3
"""Static 4-node finite elements of a block on a rigid floor: unilateral contact with Coulomb friction.

24 x 12 mm, E = 1 MPa, nu = .3, 1000 kg/m3, plane strain, on a floor that leans by 30 degrees; nodes of the base stick, slip or lift. Gravity
comes in 40 steps, as friction asks for; the states of the base are found anew in each. Prints the mean displacement along the floor, and its
ratio to that of a block whose base is held. Needs numpy alone.

static_contact.py [--friction MU] [--width MM] [--height MM] [cell in mm ...]
"""
import argparse
import math

import numpy as np

E, NU, DENSITY, GRAVITY, ANGLE = 1e6, 0.3, 1000, 9.81, math.radians(30)
CORNERS = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
STIFFNESS = E / ((1 + NU) * (1 - 2 * NU)) * np.array([[1 - NU, NU, 0], [NU, 1 - NU, 0], [0, 0, (1 - 2 * NU) / 2]])


def element(h):
    """8 x 8 stiffness of a square of side h, 2 x 2 Gauss points."""
    g, K = 1 / math.sqrt(3), np.zeros((8, 8))
    for xi in (-g, g):
        for eta in (-g, g):
            B = np.zeros((3, 8))
            B[0, 0::2] = B[2, 1::2] = CORNERS[:, 0] * (1 + CORNERS[:, 1] * eta) / (2 * h)
            B[1, 1::2] = B[2, 0::2] = CORNERS[:, 1] * (1 + CORNERS[:, 0] * xi) / (2 * h)
            K += B.T @ STIFFNESS @ B * h * h / 4
    return K


def base_of(width, height, h):
    """Stiffness and load on the base, and mean displacement along the floor as base -> number, all else condensed."""
    nx, ny = round(width / h), round(height / h)
    count = (nx + 1) * (ny + 1)
    K, mass, K_e = np.zeros((2 * count, 2 * count)), np.zeros(count), element(h)
    for i in range(nx):
        for j in range(ny):
            nodes = [i + (nx + 1) * j, i + 1 + (nx + 1) * j, i + 1 + (nx + 1) * (j + 1), i + (nx + 1) * (j + 1)]
            dofs = np.array([(2 * n, 2 * n + 1) for n in nodes]).ravel()
            K[np.ix_(dofs, dofs)] += K_e
            mass[nodes] += DENSITY * h * h / 4
    f = np.zeros(2 * count)
    f[0::2], f[1::2] = mass * GRAVITY * math.sin(ANGLE), -mass * GRAVITY * math.cos(ANGLE)
    b = 2 * (nx + 1)  # dofs of the base come first
    inner = np.linalg.solve(K[b:, b:], np.column_stack([K[b:, :b], f[b:]]))
    weight = np.repeat(mass, 2) / mass.sum()
    weight[1::2] = 0

    def mean(u):
        return weight[:b] @ u + weight[b:] @ (inner[:, -1] - inner[:, :-1] @ u)
    return K[:b, :b] - K[:b, b:] @ inner[:, :-1], f[:b] - K[:b, b:] @ inner[:, -1], mean


def rest(S, f, friction, steps=40):
    """Displacements of the base; nodes that lift; nodes that slip."""
    count = len(f) // 2
    pressed, sticks = np.ones(count, bool), np.ones(count, bool)
    way, held = np.zeros(count), np.zeros(count)  # direction of friction on what slips; where it sticks
    for step in range(1, steps + 1):
        load = f * step / steps
        for _ in range(200):
            A, r = S.copy(), load.copy()
            for k in np.flatnonzero(pressed):
                A[2 * k + 1], A[2 * k + 1, 2 * k + 1], r[2 * k + 1] = 0, 1, 0
                if sticks[k]:
                    A[2 * k], A[2 * k, 2 * k], r[2 * k] = 0, 1, held[k]
                else:  # T = way friction N
                    A[2 * k] = S[2 * k] - way[k] * friction * S[2 * k + 1]
                    r[2 * k] = load[2 * k] - way[k] * friction * load[2 * k + 1]
            u = np.linalg.solve(A, r)
            T, N = (S @ u - load).reshape(-1, 2).T
            lifts = pressed & (N < -1e-12)
            lands = ~pressed & (u[1::2] < -1e-16)
            slips = pressed & ~lifts & sticks & (np.abs(T) > friction * N * (1 + 1e-9) + 1e-13)
            stops = pressed & ~lifts & ~sticks & ((u[0::2] - held) * way > 1e-18)
            if not (lifts | lands | slips | stops).any():
                break
            way[slips] = np.sign(T[slips])
            held[lands] = u[0::2][lands]
            pressed = (pressed & ~lifts) | lands
            sticks = (sticks & ~slips) | stops | lands
        else:
            raise RuntimeError("no state of the base settles")
        held = u[0::2].copy()
    return u, ~pressed, pressed & ~sticks


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--friction", type=float, default=0.7)
    parser.add_argument("--width", type=float, default=24, help="mm")
    parser.add_argument("--height", type=float, default=12, help="mm")
    parser.add_argument("cells", type=float, nargs="*", default=[2, 1], help="mm")
    arguments = parser.parse_args()
    print("cell[mm]  held[m]      unilateral[m]  ratio   lift  slip")
    for h in arguments.cells:
        S, f, mean = base_of(arguments.width * 1e-3, arguments.height * 1e-3, h * 1e-3)
        held = mean(np.zeros(len(f)))
        u, lifted, slipping = rest(S, f, arguments.friction)
        print("%-8g  %.5e  %.5e    %.4f  %4d  %4d" % (h, held, mean(u), mean(u) / held, lifted.sum(), slipping.sum()))


if __name__ == "__main__":
    main()
