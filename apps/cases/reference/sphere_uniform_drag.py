#!/usr/bin/python3
"""Drag of a sphere in unbounded, uniform, steady, axisymmetric flow.

Units: sphere radius a = 1, stream U = 1 (along mu = +1), density 1,
nu = 2/Re with Re = U D/nu.  CD = F / (rho U^2/2 * pi D^2/4).

Equations (xi = ln r, mu = cos theta), Stokes stream function psi and
Z = E^2 psi = -r sin(theta) * vorticity:

  psi_xixi - psi_xi + (1-mu^2) psi_mumu = exp(2 xi) Z
  Z_xixi   - Z_xi   + (1-mu^2) Z_mumu   = (Re/2) exp(-xi) *
      [ psi_xi (Z_mu + 2 mu Z/(1-mu^2)) - psi_mu (Z_xi - 2 Z) ]

Boundary conditions
  sphere: psi = psi_xi = 0 (Woods' compact formula for the wall value of Z).
  r = R, written between the last two nodes r1 < r2 of the mesh:
    far = "oseen":   (psi' - O)(r2) = (r1/r2)^n (psi' - O)(r1) for each mode,
                     psi' = psi - r^2 (1-mu^2)/2, with the Oseenlet of the
                     computed drag, O = -m (1+mu) (1 - exp(-k r (1-mu))),
                     k = Re/4, m = CD/8: exact for the Oseenlet plus any
                     decaying irrotational motion;
    far = "uniform": psi' = 0 (cruder, for comparison);
    both:            Z(r2) = Z(r1) (1 + 1/(k r2)) / (1 + 1/(k r1))
                                   exp(-k (r2-r1) (1-mu)),
                     exact for the Oseenlet.

Method
  psi = r^2 (1-mu^2)/2 + sum p_n(xi) Q_n(mu),  Z = sum z_n(xi) Q_n(mu),
  Q_n = (1-mu^2) P_n'(mu), n = 1..N (Gegenbauer functions, as in the series
  method of Dennis & Walker 1971); Galerkin in mu with Gauss quadrature that
  is exact for the products; central second-order differences on a uniform
  mesh in xi; Newton with a direct block-tridiagonal solve.

Drag from the wall:  CD_friction = 32/(3 Re) z_1,
                     CD_pressure = -16/(3 Re) dz_1/dr.

Reported value: Richardson limit in h of three meshes h, h/2, h/4, for the
friction and pressure parts one by one.
Error estimate: sum of |limit(h/4,h/2) - limit(h/2,h)| of both parts, the
change when N is reduced, and the change between the two outermost far
boundaries.
Check: CD from the dissipation integral nu * int vorticity^2 dV, which uses the
whole field instead of the wall values (beyond r = R only the Oseenlet is
counted, so this check converges slower in R than CD itself).

Run:  OMP_NUM_THREADS=1 /usr/bin/python3 sphere_uniform_drag.py [Re ...]
"""
import os
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import sys
import time

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.integrate import trapezoid
from scipy.interpolate import CubicSpline
from scipy.linalg import lu_factor, lu_solve


class Angular:
    """Tables of the angular basis at the Gauss points, and the projection."""

    def __init__(self, n_modes):
        self.n = np.arange(1, n_modes + 1)
        self.lam = self.n * (self.n + 1.0)
        mu, w = leggauss((3 * n_modes) // 2 + 2)
        p = np.zeros((mu.size, n_modes + 1))
        dp = np.zeros_like(p)
        p[:, 0], p[:, 1], dp[:, 1] = 1.0, mu, 1.0
        for k in range(2, n_modes + 1):
            p[:, k] = ((2 * k - 1) * mu * p[:, k - 1] - (k - 1) * p[:, k - 2]) / k
            dp[:, k] = dp[:, k - 2] + (2 * k - 1) * p[:, k - 1]
        self.mu = mu
        self.q = (1 - mu**2)[:, None] * dp[:, 1:]              # Q_n
        self.dq = -self.lam * p[:, 1:]                         # dQ_n/dmu
        self.a = self.dq + 2 * mu[:, None] * dp[:, 1:]         # Q_n' + 2 mu Q_n/(1-mu^2)
        # f = sum c_n Q_n  ->  c = proj @ f
        self.proj = ((2 * self.n + 1) / (2 * self.lam))[:, None] * (w[:, None] * dp[:, 1:]).T


class Flow:
    """Discrete problem for one Re, outer radius, mode number and mesh."""

    def __init__(self, re, r_out, n_modes, n_cells, far="oseen"):
        self.re, self.r_out = re, r_out
        self.ang = Angular(n_modes)
        self.nm, self.nc = n_modes, n_cells
        self.h = np.log(r_out) / n_cells
        self.xi = self.h * np.arange(n_cells + 1)
        self.k = re / 4
        ang = self.ang
        r1, r2 = r_out * np.exp(-self.h), r_out
        ratio = (self.k + 1 / r2) / (self.k + 1 / r1) * np.exp(-self.k * (r2 - r1) * (1 - ang.mu))
        self.z_ratio = ang.proj @ (ratio[:, None] * ang.q)
        if far == "oseen":
            self.p_ratio = np.exp(-ang.n * self.h)
            self.p_shape = self.oseenlet(r2) - self.p_ratio * self.oseenlet(r1)
        else:
            self.p_ratio = self.p_shape = np.zeros(n_modes)

    def oseenlet(self, r):
        """Modes of the Oseenlet's stream function for m = 1."""
        mu = self.ang.mu
        return self.ang.proj @ (-(1 + mu) * (1 - np.exp(-self.k * r * (1 - mu))))

    def block(self, j, p, z, cd):
        """Residual at node j and its derivative by nodes j-1, j, j+1."""
        nm, h, ang, x = self.nm, self.h, self.ang, self.xi[j]
        ip, iz = np.arange(nm), np.arange(nm) + nm
        res = np.zeros(2 * nm)
        lo, di, up = (np.zeros((2 * nm, 2 * nm)) for _ in range(3))
        if j == 0:
            base0, base1 = 0.5, 0.5 * np.exp(2 * h)
            res[:nm] = p[0]
            res[0] += base0
            di[ip, ip] = 1
            c0, c1 = h * h * (1 / 3 + h / 2), h * h / 6
            res[nm:] = p[1] - c0 * z[0] - c1 * z[1]
            res[nm] += base1
            di[iz, iz], up[iz, ip], up[iz, iz] = -c0, 1, -c1
            s = 1 / h**2
            res[nm:] *= s
            di[nm:] *= s
            up[nm:] *= s
            return res, lo, di, up
        if j == self.nc:
            res[:nm] = p[j] - self.p_ratio * p[j - 1] - self.p_shape * (cd / 8)
            res[nm:] = z[j] - self.z_ratio @ z[j - 1]
            di[ip, ip] = di[iz, iz] = 1
            lo[ip, ip] = -self.p_ratio
            lo[nm:, nm:] = -self.z_ratio
            return res, lo, di, up
        zx = (z[j + 1] - z[j - 1]) / (2 * h)
        px = (p[j + 1] - p[j - 1]) / (2 * h)
        e2 = np.exp(2 * x)
        # stream function equation
        res[:nm] = ((p[j + 1] - 2 * p[j] + p[j - 1]) / h**2 - px
                    - ang.lam * p[j] - e2 * z[j])
        lo[ip, ip] = 1 / h**2 + 0.5 / h
        up[ip, ip] = 1 / h**2 - 0.5 / h
        di[ip, ip] = -2 / h**2 - ang.lam
        di[ip, iz] = -e2
        # vorticity equation
        psi_x = ang.q @ px + e2 * (1 - ang.mu**2)
        psi_m = ang.dq @ p[j] - e2 * ang.mu
        az, qz, qzx = ang.a @ z[j], ang.q @ z[j], ang.q @ zx
        c = 0.5 * self.re * np.exp(-x)
        nl = psi_x * az - psi_m * (qzx - 2 * qz)
        res[nm:] = ((z[j + 1] - 2 * z[j] + z[j - 1]) / h**2 - zx
                    - ang.lam * z[j] - c * (ang.proj @ nl))
        t = -c * ang.proj
        d_px = (t * az) @ ang.q
        d_p = -(t * (qzx - 2 * qz)) @ ang.dq
        d_z = (t * psi_x) @ ang.a + 2 * (t * psi_m) @ ang.q
        d_zx = -(t * psi_m) @ ang.q
        d_zx[ip, ip] -= 1
        di[nm:, :nm] = d_p
        di[nm:, nm:] = d_z
        di[iz, iz] += -2 / h**2 - ang.lam
        lo[iz, iz] = 1 / h**2
        lo[nm:, :nm] = -d_px / (2 * h)
        up[nm:, :nm] = d_px / (2 * h)
        lo[nm:, nm:] -= d_zx / (2 * h)
        up[nm:, nm:] = d_zx / (2 * h)
        up[iz, iz] += 1 / h**2
        return res, lo, di, up

    def drag(self, z):
        """Friction and pressure parts of CD (fourth-order wall derivative)."""
        f = z[:5, 0]
        dz = np.dot([-25, 48, -36, 16, -3], f) / (12 * self.h)
        return 32 / (3 * self.re) * f[0], -16 / (3 * self.re) * dz

    def drag_from_dissipation(self, z):
        """Check: F U = nu * integral of vorticity^2, Oseenlet beyond r = R."""
        r = np.exp(self.xi)
        inner = trapezoid((z**2) @ (2 * self.ang.lam / (2 * self.ang.n + 1)) * r, self.xi)
        c = 2 * self.k * sum(self.drag(z)) / 8
        tail_r = self.r_out * np.exp(np.linspace(0, 20, 4001))
        a = 2 * self.k * tail_r          # int (1-mu^2) exp(-a(1-mu)) dmu
        ang_int = 2 * (a - 1) / a**3 + 2 * np.exp(-2 * a) * (a + 1) / a**3
        tail = trapezoid((c * (self.k + 1 / tail_r))**2 * ang_int * tail_r, np.log(tail_r))
        return (2 / self.re) * 2 * np.pi * (inner + tail) / (np.pi / 2)

    def separation_angle(self, z):
        """Degrees from the rear stagnation point; 0 when attached."""
        w = self.ang.q @ z[0]
        i = np.nonzero(w < 0)[0]
        i = i[self.ang.mu[i] > 0]
        if i.size == 0:
            return 0.0
        i = i[0]
        mu = np.interp(0, [w[i], w[i - 1]], [self.ang.mu[i], self.ang.mu[i - 1]])
        return np.degrees(np.arccos(mu))

    def start(self):
        """Stokes flow, cut off to the Oseenlet scale."""
        r = np.exp(self.xi)
        p, z = (np.zeros((self.nc + 1, self.nm)) for _ in range(2))
        cut = np.exp(-self.k * r)
        p[:, 0] = -0.75 * r * cut + 0.25 / r + 0.75 * (np.exp(-self.k) - 1) / r
        z[:, 0] = 1.5 / r * cut
        return p, z

    def solve(self, guess=None, tol=1e-9, max_iter=40):
        p, z = guess if guess is not None else self.start()
        p, z = p.copy(), z.copy()
        nm, nc = self.nm, self.nc
        cd = sum(self.drag(z))
        for _ in range(max_iter):
            store, rhs = [None] * (nc + 1), np.zeros((nc + 1, 2 * nm))
            for j in range(nc + 1):
                res, lo, di, up = self.block(j, p, z, cd)
                if j:
                    di -= lo @ store[j - 1]
                    res -= lo @ rhs[j - 1]
                lu = lu_factor(di, overwrite_a=True, check_finite=False)
                sol = lu_solve(lu, np.column_stack([up, res]), check_finite=False)
                store[j], rhs[j] = sol[:, :-1].copy(), sol[:, -1]
            for j in range(nc - 1, -1, -1):
                rhs[j] -= store[j] @ rhs[j + 1]
            p -= rhs[:, :nm]
            z -= rhs[:, nm:]
            new = sum(self.drag(z))
            step = abs(new / cd - 1)
            change = np.abs(rhs[:, nm:]).max()
            cd = new
            if step < tol and change < 1e-7:
                return p, z
            if not np.isfinite(cd):
                break
        raise RuntimeError(f"Newton failed at Re {self.re}")


def transfer(old, data, new):
    """Interpolate a solution to another mesh, mode number or outer radius."""
    out = []
    for f in data:
        g = np.zeros((new.nc + 1, new.nm))
        m = min(old.nm, new.nm)
        g[:, :m] = CubicSpline(old.xi, f)(np.minimum(new.xi, old.xi[-1]))[:, :m]
        out.append(g)
    return out


def schiller_naumann(re):
    return 24 / re * (1 + 0.15 * re**0.687)


def proudman_pearson(re):
    """Stokes-Oseen-log expansion with Chester & Breach's constant; e = Re/2."""
    e = re / 2
    lg = np.log(e)
    return 24 / re * (1 + 3 / 8 * e + 9 / 40 * e**2 * (
        lg + np.euler_gamma + 5 / 3 * np.log(2) - 323 / 360) + 27 / 80 * e**3 * lg)


# Re: (far boundaries in radii, modes at each of them, cells of the coarsest of
# the three meshes at the last one)
CASES = {
    0.1: ((250, 1000, 4000), (16, 24, 44), 160),
    1.0: ((50, 150, 500), (24, 36, 56), 120),
    5.0: ((20, 50, 150), (30, 44, 64), 120),
    10.0: ((15, 40, 100), (30, 50, 72), 120),
    20.0: ((12, 30, 75), (36, 60, 84), 120),
    40.0: ((10, 25, 60), (40, 64, 100), 120),
}
CSV = os.path.join(os.path.dirname(os.path.abspath(__file__)), "sphere_uniform_drag.csv")


def convergence(re):
    """All runs for one Re; returns (limit, error, note)."""
    radii, modes, cells = CASES[re]
    t0 = time.process_time()

    def run(r_out, nm, nc, far="oseen", prev=None):
        flow = Flow(re, r_out, nm, nc, far)
        sol = flow.solve(None if prev is None else transfer(prev[0], prev[1], flow))
        f, p = flow.drag(sol[1])
        print(f"  Re {re:5g} far {far:7s} R {r_out:5g} N {nm:3d} h {flow.h:.5f}"
              f"  cd {f + p:.6f}  friction {f:.6f} pressure {p:.6f}"
              f"  dissipation {flow.drag_from_dissipation(sol[1]):.6f}"
              f"  separation {flow.separation_angle(sol[1]):.2f} deg", flush=True)
        return flow, sol, f + p, np.array([f, p, flow.drag_from_dissipation(sol[1])])

    print(f"Re {re:g}")
    print(" far boundary (same h):")
    h = np.log(radii[-1]) / (2 * cells)
    prev, far, uni = None, [], []
    for r_out, nm in zip(radii, modes):
        nc = int(round(np.log(r_out) / h))
        prev = run(np.exp(nc * h), nm, nc, "oseen", prev)
        far.append(prev[2])
        uni.append(run(np.exp(nc * h), nm, nc, "uniform", prev)[2])
    mid = prev
    print(" modes (last R):")
    less = run(radii[-1], (3 * modes[-1]) // 4, 2 * cells, "oseen", mid)
    print(" mesh (last R):")
    coarse = run(radii[-1], modes[-1], cells, "oseen", mid)
    fine = run(radii[-1], modes[-1], 4 * cells, "oseen", mid)
    c1, c2, c3 = coarse[3], mid[3], fine[3]     # friction, pressure, dissipation
    order = np.log2(np.abs((c1 - c2) / (c2 - c3)))
    lim_a, lim = c2 + (c2 - c1) / 3, c3 + (c3 - c2) / 3
    d_mesh = np.abs(lim - lim_a)[:2].sum()
    d_modes, d_far = abs(less[2] - c2[:2].sum()), far[-1] - far[-2]
    err = d_mesh + d_modes + abs(d_far)
    fr, pr, ds = lim
    hs = "/".join(f"{np.log(radii[-1]) / (i * cells):.4f}" for i in (1, 2, 4))
    cds = "/".join(f"{c[:2].sum():.5f}" for c in (c1, c2, c3))
    note = (f"R = {radii[-1]:g} radii, N = {modes[-1]} modes, h = {hs}: cd {cds}; "
            f"order friction {order[0]:.2f}, pressure {order[1]:.2f}; limits friction "
            f"{fr:.5f}, pressure {pr:.5f} (ratio {fr / pr:.4f}); limit change {d_mesh:.0e}; "
            f"far R {radii[-2]:g}->{radii[-1]:g}: {d_far:+.0e} (uniform stream instead "
            f"of Oseenlet: {uni[-1] - far[-1]:+.0e}); N {3 * modes[-1] // 4}->{modes[-1]}: "
            f"{d_modes:.0e}; check, cd from dissipation {ds:.5f}; separation angle "
            f"{fine[0].separation_angle(fine[1][1]):.1f} deg")
    print(f" {note}\n CPU {time.process_time() - t0:.0f} s")
    return fr + pr, err, note


def main():
    res = [float(a) for a in sys.argv[1:]]
    rows = [(re, *convergence(re)) for re in (res or CASES)]
    lines = [
        "# Drag coefficient of a sphere in unbounded uniform steady axisymmetric flow.",
        "# Re = U D/nu, CD = F/(rho U^2/2 pi D^2/4).  Written by sphere_uniform_drag.py.",
        "# Method: stream function and vorticity; Gegenbauer-Galerkin in theta, second-order",
        "#   central differences in xi = ln r, Newton; Oseenlet far-boundary condition at r = R.",
        "# cd: Richardson limit (h^2) of the two finest of three meshes in xi, friction and",
        "#   pressure parts extrapolated one by one (their h^2 errors partly cancel in the sum).",
        "# cd_error_estimate: |change of the limit between mesh pairs| + |change with fewer",
        "#   modes| + |change between the two outermost far boundaries|.",
        "# check, cd from dissipation: whole-field integral, Oseenlet beyond R; its error in R",
        "#   is larger than that of cd (Re 40: 1.853, 1.804, 1.793 at R = 10, 25, 60).",
        "# schiller_naumann = 24/Re (1 + 0.15 Re^0.687); deviation_percent = 100 (SN/cd - 1).",
    ]
    lines += [f"# Re {re:g}: {note}" for re, _, _, note in rows]
    lines += ["re,cd,cd_error_estimate,schiller_naumann,deviation_percent"]
    for re, cd, err, _ in rows:
        sn = schiller_naumann(re)
        lines.append(f"{re:g},{cd:.6g},{err:.1g},{sn:.6g},{100 * (sn / cd - 1):.2f}")
    print("\n" + "\n".join(lines))
    for re, cd, _, _ in rows:
        if re <= 1:
            print(f"Re {re:g}: cd {cd:.5f}, Oseen 24/Re (1+3Re/16) {24/re*(1+3*re/16):.5f},"
                  f" log expansion {proudman_pearson(re):.5f}")
    if not res:                       # the full table only
        with open(CSV, "w") as f:
            f.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
