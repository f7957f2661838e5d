"""Constitutive laws of the oracle: one class per law, one object per particle.

stress()        Cauchy stress (xx, yy, zz, xy), Pa
force_stress()  T (xx, yy, xy) with internal force f = -V0 T G
area_ratio()    V / V0 in the plane, for nodal volumes
"""
import math


class Elastic:
    follows_deformation = False
    """Isotropic constants; plane stress replaces lambda by 2 lambda G/(lambda + 2 G) (docs/theory/kinematics.md, elasticity with large rotation)."""

    def __init__(self, spec, analysis):
        E, nu = spec["E"], spec["nu"]
        self.plane_stress = analysis == "plane_stress"
        self.follows_deformation = False
        self.nu = nu
        self.G = E / (2 * (1 + nu))
        self.lam = E * nu / ((1 + nu) * (1 - 2 * nu))
        self.lam_plane = 2 * self.lam * self.G / (self.lam + 2 * self.G) if self.plane_stress else self.lam

    def hooke(self, exx, eyy, exy):
        """(xx, yy, zz, xy) of C:e, exy the tensor shear strain."""
        trace = self.lam_plane * (exx + eyy)
        zz = 0.0 if self.plane_stress else trace
        return trace + 2 * self.G * exx, trace + 2 * self.G * eyy, zz, 2 * self.G * exy


class SmallStrain(Elastic):
    """N03 as it stands: strain increments of Eq. 35, specific stress sigma/rho0, volume of Eq. 9 (conventions 43)."""

    def __init__(self, spec, analysis):
        super().__init__(spec, analysis)
        self.rho0 = spec["density"]
        self.strain = [0.0, 0.0, 0.0]
        self.specific_stress = [0.0, 0.0, 0.0, 0.0]

    def update(self, L, dt):
        increment = dt * L[0][0], dt * L[1][1], dt * (L[0][1] + L[1][0]) / 2  # N03 Eq. 35
        for k, d_sigma in enumerate(self.hooke(*increment)):
            self.specific_stress[k] += d_sigma / self.rho0
        for k in range(3):
            self.strain[k] += increment[k]

    def stress(self):
        return [self.rho0 * s for s in self.specific_stress]

    def force_stress(self):
        xx, yy, _, xy = self.stress()
        return xx, yy, xy

    def area_ratio(self):
        return (1 + self.strain[0]) * (1 + self.strain[1])  # N03 Eq. 9

    def energy_density(self):
        xx, yy, _, xy = self.stress()
        return 0.5 * (xx * self.strain[0] + yy * self.strain[1] + 2 * xy * self.strain[2])


class FiniteDeformation(Elastic):
    follows_deformation = True

    def __init__(self, spec, analysis):
        super().__init__(spec, analysis)
        self.follows_deformation = True
        self.F = [[1.0, 0.0], [0.0, 1.0]]

    def update(self, L, dt):
        """F <- (I + L dt + (L dt)^2/2) F (docs/theory/kinematics.md, deformation gradient)."""
        A = [[L[i][j] * dt for j in range(2)] for i in range(2)]
        dF = [[(i == j) + A[i][j] + 0.5 * (A[i][0] * A[0][j] + A[i][1] * A[1][j]) for j in range(2)] for i in range(2)]
        self.F = [[dF[i][0] * self.F[0][j] + dF[i][1] * self.F[1][j] for j in range(2)] for i in range(2)]

    def area_ratio(self):
        return self.F[0][0] * self.F[1][1] - self.F[0][1] * self.F[1][0]

    def volume_ratio(self):
        return self.area_ratio()

    def force_stress(self):
        xx, yy, _, xy = self.stress()
        J = self.volume_ratio()
        return J * xx, J * yy, J * xy


class LargeRotation(FiniteDeformation):
    """W = lambda/2 (tr e)^2 + G |e|^2 with e = U - I, F = R U: Kirchhoff tau = R T U R^T, T = C:e; f = -V0 tau G."""

    def stretch(self):
        """cos, sin of R and U - I, by the closed form tan(theta) = (F21 - F12)/(F11 + F22)."""
        F = self.F
        theta = math.atan2(F[1][0] - F[0][1], F[0][0] + F[1][1])
        c, s = math.cos(theta), math.sin(theta)
        return c, s, c * F[0][0] + s * F[1][0] - 1, -s * F[0][1] + c * F[1][1] - 1, c * F[0][1] + s * F[1][1]

    def stress(self):
        J = self.volume_ratio()
        c, s, exx, eyy, exy = self.stretch()
        Txx, Tyy, Tzz, Txy = self.hooke(exx, eyy, exy)
        xx, yy, xy = Txx * (1 + exx) + Txy * exy, Tyy * (1 + eyy) + Txy * exy, Txx * exy + Txy * (1 + eyy)
        return [(c * c * xx - 2 * c * s * xy + s * s * yy) / J, (s * s * xx + 2 * c * s * xy + c * c * yy) / J, Tzz / J,
                (c * s * (xx - yy) + (c * c - s * s) * xy) / J]

    def volume_ratio(self):
        J = self.area_ratio()
        if self.plane_stress:  # the thickness stretches by 1 - nu/(1 - nu) tr(U - I)
            _, _, exx, eyy, _ = self.stretch()
            J *= 1 - self.nu / (1 - self.nu) * (exx + eyy)
        return J

    def energy_density(self):
        _, _, exx, eyy, exy = self.stretch()
        xx, yy, _, xy = self.hooke(exx, eyy, exy)
        return 0.5 * (xx * exx + yy * eyy + 2 * xy * exy)


class NeoHookean(FiniteDeformation):
    """sigma = (lambda ln J / J) I + (mu/J)(b - I), plane strain (docs/theory/kinematics.md, neo-Hookean solid)."""

    def stress(self):
        F, J = self.F, self.area_ratio()
        bxx = F[0][0] ** 2 + F[0][1] ** 2
        byy = F[1][0] ** 2 + F[1][1] ** 2
        bxy = F[0][0] * F[1][0] + F[0][1] * F[1][1]
        pressure = self.lam * math.log(J) / J
        return [pressure + self.G / J * (bxx - 1), pressure + self.G / J * (byy - 1), pressure, self.G / J * bxy]

    def energy_density(self):
        F, J = self.F, self.area_ratio()
        trace = sum(F[i][j] ** 2 for i in range(2) for j in range(2))
        return 0.5 * self.lam * math.log(J) ** 2 + self.G * (0.5 * (trace - 2) - math.log(J))


def product(A, B):
    return [[sum(A[i][k] * B[k][j] for k in range(2)) for j in range(2)] for i in range(2)]


def inverse(A):
    det = A[0][0] * A[1][1] - A[0][1] * A[1][0]
    return [[A[1][1] / det, -A[0][1] / det], [-A[1][0] / det, A[0][0] / det]]


def transposed(A):
    return [[A[j][i] for j in range(2)] for i in range(2)]


def principal(b):
    """Eigenvalues and the angle of the first axis of a symmetric tensor."""
    angle = 0.5 * math.atan2(2 * b[0][1], b[0][0] - b[1][1])
    c, s = math.cos(angle), math.sin(angle)
    along = c * c * b[0][0] + 2 * c * s * b[0][1] + s * s * b[1][1]
    across = s * s * b[0][0] - 2 * c * s * b[0][1] + c * c * b[1][1]
    return (along, across), angle


def tensor(values, angle):
    c, s = math.cos(angle), math.sin(angle)
    xy = c * s * (values[0] - values[1])
    return [[c * c * values[0] + s * s * values[1], xy], [xy, s * s * values[0] + c * c * values[1]]]


class J2(FiniteDeformation):
    """J2 plasticity, F = F_e F_p, with logarithmic elastic strains (docs/theory/materials.md): F_p is kept, and principal stresses t fulfil
    e_trial = C^-1 t + flow dq/dt with q(t) = Y(alpha + flow), the flow by bisection."""

    def __init__(self, spec, analysis):
        super().__init__(spec, analysis)
        self.E = spec["E"]
        self.Y, self.H = spec["yield_stress"], spec.get("hardening_modulus", 0.0)
        self.Fp_inverse = [[1.0, 0.0], [0.0, 1.0]]
        self.thickness_plastic = 0.0  # logarithm of F_p zz
        self.alpha = self.work = 0.0
        self.tau = [[0.0, 0.0], [0.0, 0.0]]
        self.tau_zz = 0.0

    def stresses(self, e, g):
        """Principal stresses of trial strains when the flow over q is g, and q."""
        if self.plane_stress:
            # (C^-1 + g P) t = e, P = [[1, -1/2], [-1/2, 1]]
            a, b = 1 / self.E + g, -self.nu / self.E - g / 2
            det = a * a - b * b
            t = (a * e[0] - b * e[1]) / det, (a * e[1] - b * e[0]) / det, 0.0
        else:
            mean = sum(e) / 3
            pressure = (3 * self.lam + 2 * self.G) * mean
            t = tuple(pressure + 2 * self.G * (x - mean) / (1 + 3 * self.G * g) for x in e)
        return t, math.sqrt(0.5 * ((t[0] - t[1]) ** 2 + (t[1] - t[2]) ** 2 + (t[2] - t[0]) ** 2))

    def update(self, L, dt):
        super().update(L, dt)
        Fe = product(self.F, self.Fp_inverse)
        values, angle = principal(product(Fe, transposed(Fe)))
        e = [0.5 * math.log(v) for v in values] + [-self.thickness_plastic]  # zz: plane strain alone
        g = 0.0
        t, q = self.stresses(e, g)
        yielding = q - self.Y - self.H * self.alpha
        if yielding > 0:
            low, high = 0.0, 2 * q / (self.G * self.Y)  # q falls as 1/(1 + g E/(2 (1 - nu))) at least
            while self.stresses(e, high)[1] * (1 - self.H * high) > self.Y + self.H * self.alpha:
                high *= 2
            for _ in range(200):
                g = 0.5 * (low + high)
                if not low < g < high:
                    break
                t, q = self.stresses(e, g)
                if q * (1 - self.H * g) > self.Y + self.H * self.alpha:
                    low = g
                else:
                    high = g
            flow = g * q
            self.work += flow * (self.Y + self.H * (self.alpha + flow / 2))
            self.alpha += flow
            # dq/dt of each principal stress times the flow
            plastic = [g * (1.5 * x - 0.5 * sum(t)) for x in t]
            relax = tensor([math.exp(-plastic[0]), math.exp(-plastic[1])], angle)
            self.Fp_inverse = product(inverse(self.F), product(relax, Fe))
            self.thickness_plastic += plastic[2]
        self.tau = tensor(t, angle)
        self.tau_zz = t[2]

    def volume_ratio(self):
        J = self.area_ratio()
        if self.plane_stress:
            J *= math.exp(-self.nu / self.E * (self.tau[0][0] + self.tau[1][1]) + self.thickness_plastic)
        return J

    def force_stress(self):
        return self.tau[0][0], self.tau[1][1], self.tau[0][1]

    def stress(self):
        J = self.volume_ratio()
        return [self.tau[0][0] / J, self.tau[1][1] / J, self.tau_zz / J, self.tau[0][1] / J]

    def energy_density(self):
        xx, yy, xy = self.force_stress()
        zz = self.tau_zz
        return ((1 + self.nu) * (xx * xx + yy * yy + zz * zz + 2 * xy * xy) - self.nu * (xx + yy + zz) ** 2) / (2 * self.E)


LAWS = {"j2_plasticity": J2, "elastic_small_strain": SmallStrain, "elastic_large_rotation": LargeRotation, "neo_hookean": NeoHookean}
