#!/usr/bin/env python3
"""Static 4-node finite elements for the double cantilever beam of N03 sec. 3.1 (validation rows 3, 4), half model.

100 x 36 x 1 mm, crack of 50 mm on the mid-plane, E = 0.1 MPa, nu = .33, plane stress; symmetry u_y = 0 on y = 0, x >= 50 mm;
0.4 mN on the first particle column of the arm, spread over its particles with the shape functions, as the particle model has
it (conventions 40). Full 2 x 2 Gauss quadrature. The mid-plane stress is extrapolated as N03 Fig. 2 does for MPM: stresses at
the 2 x 2 particle positions of each element, averaged at the nodes with weights m_p S_ip.

static_fe.py               opening of the mouth on a row of grids
static_fe.py --write DIR   also writes dcb_fe_h2.csv and dcb_fe_h1.csv
"""
import argparse
import math
import os

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

LENGTH, ARM, CRACK, THICKNESS = 0.100, 0.018, 0.050, 0.001
E, NU, LOAD = 1e5, 0.33, 0.4e-3
NODES = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
D = E / (1 - NU**2) * np.array([[1, NU, 0], [NU, 1, 0], [0, 0, (1 - NU) / 2]])


def shape(xi, eta):
    return (1 + NODES[:, 0] * xi) * (1 + NODES[:, 1] * eta) / 4


def strain_matrix(xi, eta, h):
    """3 x 8 matrix of a square element of side h."""
    dx = NODES[:, 0] * (1 + NODES[:, 1] * eta) / (2 * h)
    dy = NODES[:, 1] * (1 + NODES[:, 0] * xi) / (2 * h)
    B = np.zeros((3, 8))
    B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = dx, dy, dy, dx
    return B


def solve(h):
    """Displacements (nodes x 2), shape (columns, rows) of the node grid."""
    nx, ny = round(LENGTH / h), round(ARM / h)
    node = lambda i, j: i + (nx + 1) * j
    g = 1 / math.sqrt(3)
    K_e = sum(strain_matrix(x, y, h).T @ D @ strain_matrix(x, y, h) for x in (-g, g) for y in (-g, g)) * THICKNESS * h * h / 4
    elements = np.array([[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)] for j in range(ny) for i in range(nx)])
    dofs = np.stack([2 * elements, 2 * elements + 1], axis=2).reshape(len(elements), 8)
    size = 2 * (nx + 1) * (ny + 1)
    rows, columns = np.repeat(dofs, 8, axis=1).ravel(), np.tile(dofs, (1, 8)).ravel()
    K = coo_matrix((np.tile(K_e.ravel(), len(dofs)), (rows, columns)), (size, size)).tocsr()
    f = np.zeros(size)
    for j in range(ny):  # first particle column: xi = -1/2 of the first element of each row, two particles each
        for eta in (-0.5, 0.5):
            f[dofs[j * nx][1::2]] += LOAD / (2 * ny) * shape(-0.5, eta)
    fixed = [2 * node(i, 0) + 1 for i in range(nx + 1) if i * h >= CRACK - 1e-9 * h]  # the tip node is closed
    fixed.append(2 * node(nx, 0))  # no rigid motion along x
    free = np.setdiff1d(np.arange(size), fixed)
    u = np.zeros(size)
    u[free] = spsolve(K[free][:, free].tocsc(), f[free])
    return u.reshape(-1, 2), elements, (nx + 1, ny + 1)


def mid_plane_stress(u, elements, columns, h):
    """sigma_xx at the nodes of y = 0: sum m_p S_ip sigma_p / sum m_p S_ip over 2 x 2 particles per element."""
    weight, total = np.zeros(columns), np.zeros(columns)
    for e in elements[:columns - 1]:
        for xi in (-0.5, 0.5):
            for eta in (-0.5, 0.5):
                sigma = D @ strain_matrix(xi, eta, h) @ u[e].ravel()
                S = shape(xi, eta)
                for k in (0, 1):  # the two nodes on the mid-plane
                    weight[e[k]] += S[k]
                    total[e[k]] += S[k] * sigma[0]
    return total / weight


def write(path, h):
    u, elements, (columns, _) = solve(h)
    sigma = mid_plane_stress(u, elements, columns, h)
    with open(path, "w") as stream:
        stream.write("# Static 4-node finite element solution of the double cantilever beam of N03 3.1 (half model, plane stress),\n"
                     "# cells of %g mm; made by tests/oracle/static_fe.py --write tests/oracle/data\n"
                     "# sigma_xx is extrapolated from 2 x 2 particle positions per element by mass-weighted shape functions\n"
                     "x[m],sigma_xx[Pa],u_y[m]\n" % (h * 1e3))
        for i in range(columns):
            stream.write("%.6g,%.12g,%.12g\n" % (i * h, sigma[i], u[i, 1] if abs(u[i, 1]) > 0 else 0.0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", metavar="DIR")
    parser.add_argument("--finest", type=float, default=0.25, help="finest cell, mm")
    arguments = parser.parse_args()
    openings, h = [], 2e-3
    print("cell[mm]  u_y(0, inner face)[mm]  difference[mm]")
    while h >= arguments.finest * 1e-3 * (1 - 1e-9):
        u, _, _ = solve(h)
        openings.append(u[0, 1] * 1e3)
        print("%-8g  %.6f  %s" % (h * 1e3, openings[-1], "%.6f" % (openings[-1] - openings[-2]) if len(openings) > 1 else ""))
        h /= 2
    if len(openings) >= 3:
        a, b, c = openings[-3:]
        order = math.log2((b - a) / (c - b))
        print("order %.2f, extrapolated %.5f mm" % (order, c + (c - b) / (2**order - 1)))
    if arguments.write:
        write(os.path.join(arguments.write, "dcb_fe_h2.csv"), 2e-3)
        write(os.path.join(arguments.write, "dcb_fe_h1.csv"), 1e-3)


if __name__ == "__main__":
    main()
