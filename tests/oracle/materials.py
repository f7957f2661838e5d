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


LAWS = {"elastic_small_strain": SmallStrain, "elastic_large_rotation": LargeRotation, "neo_hookean": NeoHookean}
