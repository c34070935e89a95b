// capsule_bem.cpp -- boundary-integral reference for a neo-Hookean capsule in
// unbounded simple shear flow u = G y e_x, viscosity ratio 1, no bending.
//
// Units: a = 1 (radius of the sphere of equal volume), G = 1, mu = 1, hence the
// surface shear modulus is Gs = 1/(3 Ca), Ca = mu G a / Es, Es = 3 Gs.
//
// Method
//   mesh      icosphere (icosahedron split in 4, n times; projected), scaled so that
//             the polyhedron has the volume 4 pi/3; it is the stress-free state.
//   membrane  W = Gs/2 (I1 + 1/J^2 - 3) per undeformed area, linear triangles,
//             nodal force F = -dE/dx, exact.
//   density   f_i = F_i / (A_i) (lumped, A_i = third of adjacent deformed area) or
//             from the consistent mass matrix (M f = F, conjugate gradients);
//             linear over each flat triangle.
//   flow      u(x0) = u_inf + 1/(8 pi mu) int (I/r + r r/r^3) f dS, collocated at nodes;
//             touching triangles: Duffy; near: 7-point on 4^m parts; middle: 7-point;
//             far: 3-point.
//   time      RKC2 (Runge-Kutta-Chebyshev, second order, stabilised;
//             Sommeijer, Shampine & Verwer 1998), the number of stages from the
//             spectral radius by power iteration.
//   symmetry  the mesh, flow and so the exact solution are symmetric under (x, y, z) ->
//             (-x, -y, -z) and z -> -z; by default only one quarter of the nodes are collocated and
//             the rest mirrored (--full 1 turns that off).
//
// Build: g++ -O3 -march=native -mprefer-vector-width=512 -ffast-math -fno-finite-math-only -std=c++17 capsule_bem.cpp -o capsule_bem
// Use:   capsule_bem --test          validation
//        capsule_bem --ca 0.1 --level 4 --dt 0.02 --tend 8 [--quad 0..2]
//                    [--mass 0|1] [--full 0|1] [--single 0|1] [--bend kb/(Es a^2)] [--tag name]
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

using Vec3 = std::array<double, 3>;
using Tri = std::array<int, 3>;
using VecN = std::vector<Vec3>;

static inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
static inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
static inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
static inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
static inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

// ---------------------------------------------------------------- mesh
struct Mesh {
    VecN x0;               // stress-free nodes
    std::vector<Tri> tri;  // outward orientation
    // reference data per triangle: area and gradients of the shape functions (2-D frame)
    std::vector<double> area0;
    std::vector<std::array<double, 6>> grad;  // grad[t][2*i+k] = dN_i/dX_k
    std::vector<std::vector<int>> nodeTri, nodeNbr;
    std::vector<std::array<int, 2>> hinge;  // pairs of triangles with a common edge
    void finish() {
        const int n = x0.size(), m = tri.size();
        area0.resize(m);
        grad.resize(m);
        nodeTri.assign(n, {});
        nodeNbr.assign(n, {});
        for (int t = 0; t < m; ++t) {
            Vec3 e1 = x0[tri[t][1]] - x0[tri[t][0]], e2 = x0[tri[t][2]] - x0[tri[t][0]];
            double l1 = norm(e1), c = dot(e1, e2) / l1, h = norm(cross(e1, e2)) / l1;
            area0[t] = 0.5 * l1 * h;
            // nodes (0,0), (l1,0), (c,h)
            double inv = 1.0 / (l1 * h);
            grad[t] = {-h * inv, (c - l1) * inv, h * inv, -c * inv, 0.0, l1 * inv};
            for (int k = 0; k < 3; ++k) nodeTri[tri[t][k]].push_back(t);
        }
        std::map<std::pair<int, int>, int> e;
        hinge.clear();
        for (int t = 0; t < m; ++t)
            for (int k = 0; k < 3; ++k) {
                auto key = std::minmax(tri[t][k], tri[t][(k + 1) % 3]);
                auto it = e.find(key);
                if (it == e.end())
                    e[key] = t;
                else
                    hinge.push_back({it->second, t});
            }
        for (int i = 0; i < n; ++i) {
            for (int t : nodeTri[i])
                for (int j : tri[t])
                    if (j != i) nodeNbr[i].push_back(j);
            std::sort(nodeNbr[i].begin(), nodeNbr[i].end());
            nodeNbr[i].erase(std::unique(nodeNbr[i].begin(), nodeNbr[i].end()), nodeNbr[i].end());
        }
    }
};

static Mesh icosphere(int level, bool unitVolume) {
    Mesh M;
    const double p = 0.5 * (1 + std::sqrt(5.0));
    for (int s1 = -1; s1 <= 1; s1 += 2)
        for (int s2 = -1; s2 <= 1; s2 += 2) {
            M.x0.push_back({0.0, 1.0 * s1, p * s2});
            M.x0.push_back({1.0 * s1, p * s2, 0.0});
            M.x0.push_back({p * s2, 0.0, 1.0 * s1});
        }
    for (int i = 0; i < 12; ++i)
        for (int j = i + 1; j < 12; ++j)
            for (int k = j + 1; k < 12; ++k) {
                auto d = [&](int a, int b) { return norm(M.x0[a] - M.x0[b]) < 2.1; };
                if (d(i, j) && d(j, k) && d(i, k)) M.tri.push_back({i, j, k});
            }
    for (auto& v : M.x0) v = (1.0 / norm(v)) * v;
    for (int l = 0; l < level; ++l) {
        std::map<std::pair<int, int>, int> mid;
        auto midpoint = [&](int a, int b) {
            auto key = std::minmax(a, b);
            auto it = mid.find(key);
            if (it != mid.end()) return it->second;
            Vec3 v = M.x0[a] + M.x0[b];
            M.x0.push_back((1.0 / norm(v)) * v);
            return mid[key] = int(M.x0.size()) - 1;
        };
        std::vector<Tri> nt;
        for (auto& t : M.tri) {
            int a = midpoint(t[0], t[1]), b = midpoint(t[1], t[2]), c = midpoint(t[2], t[0]);
            nt.push_back({t[0], a, c});
            nt.push_back({a, t[1], b});
            nt.push_back({c, b, t[2]});
            nt.push_back({a, b, c});
        }
        M.tri = nt;
    }
    double vol = 0;
    for (auto& t : M.tri) {
        double v = dot(M.x0[t[0]], cross(M.x0[t[1]], M.x0[t[2]])) / 6;
        if (v < 0) {
            std::swap(t[1], t[2]);
            v = -v;
        }
        vol += v;
    }
    if (unitVolume) {
        double s = std::cbrt(4 * M_PI / 3 / vol);
        for (auto& v : M.x0) v = s * v;
    }
    M.finish();
    return M;
}

// ---------------------------------------------------------------- membrane
// energy and (optional) nodal forces -dE/dx
static double membrane(const Mesh& M, const VecN& x, double Gs, VecN* force) {
    double E = 0;
    if (force) force->assign(x.size(), {0, 0, 0});
    for (size_t t = 0; t < M.tri.size(); ++t) {
        const auto& T = M.tri[t];
        const auto& g = M.grad[t];
        Vec3 F1{0, 0, 0}, F2{0, 0, 0};  // columns of the deformation gradient
        for (int i = 0; i < 3; ++i) {
            F1 = F1 + g[2 * i] * x[T[i]];
            F2 = F2 + g[2 * i + 1] * x[T[i]];
        }
        double C11 = dot(F1, F1), C12 = dot(F1, F2), C22 = dot(F2, F2), J2 = C11 * C22 - C12 * C12;
        E += M.area0[t] * 0.5 * Gs * (C11 + C22 + 1 / J2 - 3);
        if (!force) continue;
        double q = 1 / (J2 * J2);  // J^-2 C^-1 = J^-4 adj(C)
        double S11 = Gs * (1 - q * C22), S22 = Gs * (1 - q * C11), S12 = Gs * q * C12;
        Vec3 P1 = S11 * F1 + S12 * F2, P2 = S12 * F1 + S22 * F2;
        for (int i = 0; i < 3; ++i) {
            Vec3& f = (*force)[T[i]];
            f = f - M.area0[t] * (g[2 * i] * P1 + g[2 * i + 1] * P2);
        }
    }
    return E;
}
// optional regularisation (not part of the problem): hinge bending energy sum kh (1 - n1.n2),
// kh = 2 kb / sqrt(3) on near-equilateral triangles; flat reference. Adds to the forces.
static double bending(const Mesh& M, const VecN& x, double kh, VecN* force) {
    const int m = M.tri.size();
    VecN nrm(m), g(m, {0, 0, 0});
    std::vector<double> len(m);
    double E = 0;
    for (int t = 0; t < m; ++t) {
        const auto& T = M.tri[t];
        Vec3 N = cross(x[T[1]] - x[T[0]], x[T[2]] - x[T[0]]);
        len[t] = norm(N);
        nrm[t] = (1 / len[t]) * N;
    }
    for (auto& h : M.hinge) {
        const Vec3 &a = nrm[h[0]], &b = nrm[h[1]];
        double c = dot(a, b);
        E += kh * (1 - c);
        g[h[0]] = g[h[0]] - (kh / len[h[0]]) * (b - c * a);
        g[h[1]] = g[h[1]] - (kh / len[h[1]]) * (a - c * b);
    }
    if (force)
        for (int t = 0; t < m; ++t)
            for (int k = 0; k < 3; ++k) {
                const auto& T = M.tri[t];
                Vec3& f = (*force)[T[k]];
                f = f - cross(x[T[(k + 1) % 3]] - x[T[(k + 2) % 3]], g[t]);
            }
    return E;
}
// least principal Cauchy tension over triangles / Gs
static double leastTension(const Mesh& M, const VecN& x, double* areaFraction) {
    double least = 1e9, neg = 0, tot = 0;
    for (size_t t = 0; t < M.tri.size(); ++t) {
        const auto& T = M.tri[t];
        const auto& g = M.grad[t];
        Vec3 F1{0, 0, 0}, F2{0, 0, 0};
        for (int i = 0; i < 3; ++i) {
            F1 = F1 + g[2 * i] * x[T[i]];
            F2 = F2 + g[2 * i + 1] * x[T[i]];
        }
        double C11 = dot(F1, F1), C12 = dot(F1, F2), C22 = dot(F2, F2);
        double J2 = C11 * C22 - C12 * C12, tr = C11 + C22, d = std::sqrt(std::max(0.0, 0.25 * tr * tr - J2));
        double l2 = 0.5 * tr - d, J = std::sqrt(J2),
               tau = (l2 - 1 / J2) / J;  // tension along the lesser stretch
        if (tau < least) least = tau;
        tot += M.area0[t];
        if (tau < 0) neg += M.area0[t];
    }
    *areaFraction = neg / tot;
    return least;
}

// ---------------------------------------------------------------- quadrature
struct QPoint {
    double b0, b1, b2, w;
};  // barycentric, weights sum to 1
static std::vector<QPoint> rule7(int split) {
    const double s = std::sqrt(15.0), a1 = (6 - s) / 21, a2 = (6 + s) / 21, w1 = (155 - s) / 1200,
                 w2 = (155 + s) / 1200;
    std::vector<QPoint> base = {{1. / 3, 1. / 3, 1. / 3, 0.225}};
    for (auto aw : {std::pair<double, double>{a1, w1}, {a2, w2}}) {
        double a = aw.first, b = 1 - 2 * a;
        base.push_back({b, a, a, aw.second});
        base.push_back({a, b, a, aw.second});
        base.push_back({a, a, b, aw.second});
    }
    for (int l = 0; l < split; ++l) {
        std::vector<QPoint> n;
        for (auto& q : base) {
            double h0 = 0.5 * q.b0, h1 = 0.5 * q.b1, h2 = 0.5 * q.b2;
            n.push_back({h0 + 0.5, h1, h2, q.w / 4});
            n.push_back({h0, h1 + 0.5, h2, q.w / 4});
            n.push_back({h0, h1, h2 + 0.5, q.w / 4});
            n.push_back({0.5 - h0, 0.5 - h1, 0.5 - h2, q.w / 4});
        }
        base = n;
    }
    return base;
}
static void gauss01(int n, std::vector<double>& x, std::vector<double>& w) {
    x.resize(n);
    w.resize(n);
    for (int i = 0; i < n; ++i) {
        double z = std::cos(M_PI * (i + 0.75) / (n + 0.5)), pp = 1;
        for (int it = 0; it < 50; ++it) {
            double p0 = 1, p1 = z;
            for (int k = 2; k <= n; ++k) {
                double p2 = ((2 * k - 1) * z * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            if (n == 1) {
                p1 = z;
                p0 = 1;
            }
            pp = n * (z * p1 - p0) / (z * z - 1);
            z -= p1 / pp;
        }
        x[i] = 0.5 * (1 - z);
        w[i] = 1 / ((1 - z * z) * pp * pp);
    }
}
// Duffy points: node 0 is the singular corner; weight includes the factor 2 s (area 1)
static std::vector<QPoint> duffy(int n) {
    std::vector<double> xs, ws, xt, wt;
    gauss01(2, xs, ws);
    gauss01(n, xt, wt);
    std::vector<QPoint> q;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < n; ++j)
            q.push_back({1 - xs[i], xs[i] * (1 - xt[j]), xs[i] * xt[j], 2 * xs[i] * ws[i] * wt[j]});
    return q;
}

// ---------------------------------------------------------------- single layer
struct Solver {
    Mesh M;
    double Ca = 0.1, Gs = 1;
    bool consistentMass = false, full = false, shear = true;
    double nearFactor = 2.0, midFactor = 4.0;
    std::vector<QPoint> qNear = rule7(1), qMid = rule7(0), qSing = duffy(8);
    std::vector<int> target, orbitOf;
    std::vector<Vec3> orbitSign;
    long evals = 0;
    std::vector<double> X, Y, Z, FX, FY, FZ;        // far points (3 per triangle)
    std::vector<double> NX, NY, NZ, NFX, NFY, NFZ;  // near points of one target
    std::vector<float> sX, sY, sZ, sFX, sFY, sFZ;
    bool singleFar = false;  // far sum in single precision (positions about 1e-7)
    double kBend = 0;        // optional bending modulus / (Es a^2), 0 = none

    void setQuadrature(int q) {
        if (q == 0) return;
        if (q == 1) {
            nearFactor = 3.0;
            midFactor = 8.0;
            qNear = rule7(2);
            qSing = duffy(14);
        }
        if (q == 2) {
            nearFactor = 4.0;
            midFactor = 1e9;
            qNear = rule7(2);
            qSing = duffy(20);
        }
    }
    void setSymmetry() {
        const int n = M.x0.size();
        target.clear();
        orbitOf.assign(n, -1);
        orbitSign.assign(n, {1, 1, 1});
        std::map<std::array<long, 3>, int> where;
        auto key = [](const Vec3& v) {
            return std::array<long, 3>{std::lround(v[0] * 1e7), std::lround(v[1] * 1e7),
                                       std::lround(v[2] * 1e7)};
        };
        for (int i = 0; i < n; ++i) where[key(M.x0[i])] = i;
        for (int i = 0; i < n; ++i) {
            if (orbitOf[i] >= 0) continue;
            int id = target.size();
            target.push_back(i);
            if (full) {
                orbitOf[i] = id;
                continue;
            }
            for (int a = 0; a < 4; ++a) {
                double p = (a & 1) ? -1 : 1, z = (a & 2) ? -1 : 1;
                Vec3 s{p, p, p * z}, v{s[0] * M.x0[i][0], s[1] * M.x0[i][1], s[2] * M.x0[i][2]};
                auto it = where.find(key(v));
                if (it == where.end()) {
                    std::fprintf(stderr, "mesh not symmetric\n");
                    std::exit(1);
                }
                if (orbitOf[it->second] < 0) {
                    orbitOf[it->second] = id;
                    orbitSign[it->second] = s;
                }
            }
        }
    }
    // force density at nodes from nodal forces
    void density(const VecN& x, const VecN& F, VecN& f) {
        const int n = x.size(), m = M.tri.size();
        std::vector<double> At(m), An(n, 0.0);
        for (int t = 0; t < m; ++t) {
            const auto& T = M.tri[t];
            At[t] = 0.5 * norm(cross(x[T[1]] - x[T[0]], x[T[2]] - x[T[0]]));
            for (int k : T) An[k] += At[t] / 3;
        }
        f.resize(n);
        for (int i = 0; i < n; ++i) f[i] = (1 / An[i]) * F[i];
        if (!consistentMass) return;
        // preconditioned CG on M f = F (condition number about 4)
        VecN r(n), z(n), p(n), q(n);
        auto mul = [&](const VecN& v, VecN& o) {
            o.assign(n, {0, 0, 0});
            for (int t = 0; t < m; ++t) {
                const auto& T = M.tri[t];
                Vec3 s = v[T[0]] + v[T[1]] + v[T[2]];
                for (int k : T) o[k] = o[k] + (At[t] / 12) * (s + v[k]);
            }
        };
        mul(f, q);
        double rz = 0, rz0;
        for (int i = 0; i < n; ++i) {
            r[i] = F[i] - q[i];
            z[i] = (1 / An[i]) * r[i];
            p[i] = z[i];
            rz += dot(r[i], z[i]);
        }
        rz0 = 0;
        for (int i = 0; i < n; ++i) rz0 += dot(F[i], F[i]) / An[i];
        for (int it = 0; it < 60 && rz > 1e-20 * rz0; ++it) {
            mul(p, q);
            double pq = 0;
            for (int i = 0; i < n; ++i) pq += dot(p[i], q[i]);
            double al = rz / pq, rn = 0;
            for (int i = 0; i < n; ++i) {
                f[i] = f[i] + al * p[i];
                r[i] = r[i] - al * q[i];
                z[i] = (1 / An[i]) * r[i];
                rn += dot(r[i], z[i]);
            }
            double be = rn / rz;
            rz = rn;
            for (int i = 0; i < n; ++i) p[i] = z[i] + be * p[i];
        }
    }
    template <class Real>
    static Vec3 stokesletSum(const Vec3& x0, const Real* px, const Real* py, const Real* pz, const Real* fx,
                             const Real* fy, const Real* fz, int nq) {
        Real ux = 0, uy = 0, uz = 0;
        const Real x_ = x0[0], y_ = x0[1], z_ = x0[2];
        for (int q = 0; q < nq; ++q) {
            Real rx = x_ - px[q], ry = y_ - py[q], rz = z_ - pz[q];
            Real ir = Real(1) / std::sqrt(rx * rx + ry * ry + rz * rz);
            Real c = (rx * fx[q] + ry * fy[q] + rz * fz[q]) * ir * ir;
            ux += ir * (fx[q] + c * rx);
            uy += ir * (fy[q] + c * ry);
            uz += ir * (fz[q] + c * rz);
        }
        return {double(ux), double(uy), double(uz)};
    }
    // velocity at nodes by the single layer (1/(8 pi)) of density f, plus shear
    void velocity(const VecN& x, const VecN& f, VecN& u) {
        const int n = x.size(), m = M.tri.size(), nq = 3 * m;
        X.resize(nq);
        Y.resize(nq);
        Z.resize(nq);
        FX.resize(nq);
        FY.resize(nq);
        FZ.resize(nq);
        std::vector<double> At(m), size(m);
        VecN cen(m);
        for (int t = 0; t < m; ++t) {
            const auto& T = M.tri[t];
            const Vec3 &a = x[T[0]], &b = x[T[1]], &c = x[T[2]];
            At[t] = 0.5 * norm(cross(b - a, c - a));
            cen[t] = (1. / 3) * (a + b + c);
            size[t] = std::sqrt(std::max({dot(a - b, a - b), dot(b - c, b - c), dot(c - a, c - a)}));
            for (int k = 0; k < 3; ++k) {
                Vec3 y = 0.5 * cen[t] + 0.5 * x[T[k]];
                Vec3 g = (At[t] / 3) * ((1. / 6) * (f[T[0]] + f[T[1]] + f[T[2]]) + 0.5 * f[T[k]]);
                int q = 3 * t + k;
                X[q] = y[0];
                Y[q] = y[1];
                Z[q] = y[2];
                FX[q] = g[0];
                FY[q] = g[1];
                FZ[q] = g[2];
            }
        }
        VecN ut(target.size());
        std::vector<float> cX(m), cY(m), cZ(m), cL(m);  // coarse test for the near triangles, in blocks
        for (int t = 0; t < m; ++t) {
            double l = std::min(1e3, 1.0001 * midFactor * size[t]);
            cX[t] = cen[t][0];
            cY[t] = cen[t][1];
            cZ[t] = cen[t][2];
            cL[t] = l * l + 1e-6;
        }
        if (singleFar) {
            sX.assign(X.begin(), X.end());
            sY.assign(Y.begin(), Y.end());
            sZ.assign(Z.begin(), Z.end());
            sFX.assign(FX.begin(), FX.end());
            sFY.assign(FY.begin(), FY.end());
            sFZ.assign(FZ.begin(), FZ.end());
        }
        const double *px = X.data(), *py = Y.data(), *pz = Z.data(), *fx = FX.data(), *fy = FY.data(),
                     *fz = FZ.data();
        for (size_t ti = 0; ti < target.size(); ++ti) {
            const int i = target[ti];
            const Vec3 xi = x[i];
            Vec3 uf = singleFar ? stokesletSum(xi, sX.data(), sY.data(), sZ.data(), sFX.data(), sFY.data(),
                                               sFZ.data(), nq)
                                : stokesletSum(xi, px, py, pz, fx, fy, fz, nq);
            int nn = 0;
            auto push = [&](double a, double b, double c, double d, double e, double g) {
                if (nn == int(NX.size()))
                    for (auto* v : {&NX, &NY, &NZ, &NFX, &NFY, &NFZ}) v->resize(nn + 4096);
                NX[nn] = a;
                NY[nn] = b;
                NZ[nn] = c;
                NFX[nn] = d;
                NFY[nn] = e;
                NFZ[nn] = g;
                ++nn;
            };
            for (int tb = 0; tb < m; tb += 16) {
                const int time_end = std::min(tb + 16, m);
                float least = 1;
                for (int t = tb; t < time_end; ++t) {
                    float dx = cX[t] - float(xi[0]), dy = cY[t] - float(xi[1]), dz = cZ[t] - float(xi[2]);
                    float e = dx * dx + dy * dy + dz * dz - cL[t];
                    least = e < least ? e : least;
                }
                if (least > 0) continue;
                for (int t = tb; t < time_end; ++t) {
                    Vec3 d = cen[t] - xi;
                    double d2 = dot(d, d), lim = midFactor * size[t];
                    if (d2 > lim * lim) continue;
                    const auto& T = M.tri[t];
                    int k0 = T[0] == i ? 0 : T[1] == i ? 1 : T[2] == i ? 2 : -1;
                    const std::vector<QPoint>* rule = &qMid;
                    if (k0 >= 0)
                        rule = &qSing;
                    else {
                        k0 = 0;
                        double nl = nearFactor * size[t];
                        if (d2 < nl * nl) rule = &qNear;
                    }
                    const int A = T[k0], B = T[(k0 + 1) % 3], C = T[(k0 + 2) % 3];
                    const Vec3 &xA = x[A], &xB = x[B], &xC = x[C], &fA = f[A], &fB = f[B], &fC = f[C];
                    for (const auto& q : *rule) {
                        double w = q.w * At[t], w0 = w * q.b0, w1 = w * q.b1, w2 = w * q.b2;
                        push(q.b0 * xA[0] + q.b1 * xB[0] + q.b2 * xC[0],
                             q.b0 * xA[1] + q.b1 * xB[1] + q.b2 * xC[1],
                             q.b0 * xA[2] + q.b1 * xB[2] + q.b2 * xC[2], w0 * fA[0] + w1 * fB[0] + w2 * fC[0],
                             w0 * fA[1] + w1 * fB[1] + w2 * fC[1], w0 * fA[2] + w1 * fB[2] + w2 * fC[2]);
                    }
                    for (int q = 3 * t; q < 3 * t + 3; ++q)
                        push(px[q], py[q], pz[q], -fx[q], -fy[q], -fz[q]);  // remove the far rule
                }
            }
            Vec3 du = uf + stokesletSum(xi, NX.data(), NY.data(), NZ.data(), NFX.data(), NFY.data(),
                                        NFZ.data(), nn);
            const double c = 1 / (8 * M_PI);
            ut[ti] = c * du;
            if (shear) ut[ti][0] += xi[1];
        }
        u.resize(n);
        for (int i = 0; i < n; ++i) {
            const Vec3& v = ut[orbitOf[i]];
            const Vec3& s = orbitSign[i];
            u[i] = {s[0] * v[0], s[1] * v[1], s[2] * v[2]};
        }
        // a node on a symmetry plane has zero velocity across it
        if (!full)
            for (int i = 0; i < n; ++i)
                if (std::fabs(M.x0[i][2]) < 1e-9) u[i][2] = 0;
    }
    VecN F_, f_;
    void rhs(const VecN& x, VecN& u) {
        membrane(M, x, Gs, &F_);
        if (kBend > 0) bending(M, x, kBend * 3 * Gs * 2 / std::sqrt(3.0), &F_);
        density(x, F_, f_);
        velocity(x, f_, u);
        ++evals;
    }

    // spectral radius of the Jacobian by the nonlinear power method
    VecN ev;
    double spectralRadius(const VecN& x, const VecN& u, int iters) {
        const int n = x.size();
        if (ev.empty()) {
            std::mt19937 g(1);
            std::normal_distribution<double> N;
            ev.resize(n);
            for (auto& v : ev) v = {N(g), N(g), N(g)};
            if (!full) {
                VecN e2(n);
                for (int i = 0; i < n; ++i) {
                    const Vec3& v = ev[target[orbitOf[i]]];
                    const Vec3& s = orbitSign[i];
                    e2[i] = {s[0] * v[0], s[1] * v[1], s[2] * v[2]};
                    if (std::fabs(M.x0[i][2]) < 1e-9) e2[i][2] = 0;
                }
                ev = e2;
            }
        }
        const double delta = singleFar ? 1e-3 : 1e-5;
        double rho = 0;
        VecN xp(n), up;
        for (int k = 0; k < iters; ++k) {
            double s = 0;
            for (auto& v : ev) s += dot(v, v);
            s = delta / std::sqrt(s);
            for (int i = 0; i < n; ++i) xp[i] = x[i] + s * ev[i];
            rhs(xp, up);
            double nn = 0;
            for (int i = 0; i < n; ++i) {
                ev[i] = up[i] - u[i];
                nn += dot(ev[i], ev[i]);
            }
            rho = std::sqrt(nn) / delta;
        }
        return rho;
    }
};

// ---------------------------------------------------------------- measures
static void eigen3(double A[3][3], double w[3], double V[3][3]) {  // Jacobi, ascending
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) V[i][j] = i == j;
    for (int s = 0; s < 60; ++s)
        for (int p = 0; p < 3; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::fabs(A[p][q]) < 1e-300) continue;
                double th = (A[q][q] - A[p][p]) / (2 * A[p][q]),
                       t = (th < 0 ? -1 : 1) / (std::fabs(th) + std::sqrt(th * th + 1)),
                       c = 1 / std::sqrt(t * t + 1), sn = t * c;
                for (int k = 0; k < 3; ++k) {
                    double a = A[k][p], b = A[k][q];
                    A[k][p] = c * a - sn * b;
                    A[k][q] = sn * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    double a = A[p][k], b = A[q][k];
                    A[p][k] = c * a - sn * b;
                    A[q][k] = sn * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    double a = V[k][p], b = V[k][q];
                    V[k][p] = c * a - sn * b;
                    V[k][q] = sn * a + c * b;
                }
            }
    for (int i = 0; i < 3; ++i) w[i] = A[i][i];
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2 - i; ++j)
            if (w[j] > w[j + 1]) {
                std::swap(w[j], w[j + 1]);
                for (int k = 0; k < 3; ++k) std::swap(V[k][j], V[k][j + 1]);
            }
}
struct Shape {
    double volume, D, axis[3], incl, Dext, Dnode, Lext, Bext, area;
    double concave, maxConcaveDeg;
};

// extremum of the distance from c near node i, by a least-squares quadratic of r over the
// tangent-plane coordinates of the two-ring
static double extremum(const Mesh& M, const VecN& x, const Vec3& c, int i) {
    Vec3 r0 = x[i] - c, e = (1 / norm(r0)) * r0, a = std::fabs(e[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 t1 = cross(e, a);
    t1 = (1 / norm(t1)) * t1;
    Vec3 t2 = cross(e, t1);
    std::vector<int> ring = {i};
    for (int j : M.nodeNbr[i]) {
        ring.push_back(j);
        for (int k : M.nodeNbr[j]) ring.push_back(k);
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    double A[6][7] = {};
    double h = 0;
    for (int j : M.nodeNbr[i]) h = std::max(h, norm(x[j] - x[i]));
    for (int j : ring) {
        Vec3 d = x[j] - c;
        double p = dot(d, t1) / h, q = dot(d, t2) / h, r = norm(d);
        double w = std::exp(-(p * p + q * q)), b[6] = {1, p, q, p * p, p * q, q * q};
        for (int k = 0; k < 6; ++k) {
            for (int l = 0; l < 6; ++l) A[k][l] += w * b[k] * b[l];
            A[k][6] += w * b[k] * r;
        }
    }
    for (int k = 0; k < 6; ++k) {
        int pv = k;
        for (int l = k + 1; l < 6; ++l)
            if (std::fabs(A[l][k]) > std::fabs(A[pv][k])) pv = l;
        for (int l = 0; l < 7; ++l) std::swap(A[k][l], A[pv][l]);
        for (int m = 0; m < 6; ++m)
            if (m != k) {
                double g = A[m][k] / A[k][k];
                for (int l = k; l < 7; ++l) A[m][l] -= g * A[k][l];
            }
    }
    double s[6];
    for (int k = 0; k < 6; ++k) s[k] = A[k][6] / A[k][k];
    double det = 4 * s[3] * s[5] - s[4] * s[4], p = (-2 * s[5] * s[1] + s[4] * s[2]) / det,
           q = (-2 * s[3] * s[2] + s[4] * s[1]) / det;
    if (!(p * p + q * q < 1.0)) return norm(r0);
    return s[0] + s[1] * p + s[2] * q + s[3] * p * p + s[4] * p * q + s[5] * q * q;
}
static Shape measure(const Mesh& M, const VecN& x) {
    Shape S{};
    double I[3][3] = {};
    Vec3 c{0, 0, 0};
    double vol = 0;
    for (const auto& T : M.tri) {
        const Vec3 &a = x[T[0]], &b = x[T[1]], &d = x[T[2]];
        double v = dot(a, cross(b, d)) / 6;
        vol += v;
        S.area += 0.5 * norm(cross(b - a, d - a));
        Vec3 s = a + b + d;
        c = c + (v / 4) * s;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)  // int xx over a tetrahedron with a corner at 0
                I[i][j] += v / 20 * (a[i] * a[j] + b[i] * b[j] + d[i] * d[j] + s[i] * s[j]);
    }
    c = (1 / vol) * c;
    S.volume = vol;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) I[i][j] = I[i][j] / vol - c[i] * c[j];
    double w[3], V[3][3];
    eigen3(I, w, V);
    for (int i = 0; i < 3; ++i) S.axis[i] = std::sqrt(5 * w[i]);
    S.D = (S.axis[2] - S.axis[0]) / (S.axis[2] + S.axis[0]);
    S.incl = std::atan(V[1][2] / V[0][2]) * 180 / M_PI;
    int imax = 0, imin = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        if (norm(x[i] - c) > norm(x[imax] - c)) imax = i;
        if (norm(x[i] - c) < norm(x[imin] - c)) imin = i;
    }
    double ln = norm(x[imax] - c), bn = norm(x[imin] - c);
    S.Lext = extremum(M, x, c, imax);
    S.Bext = extremum(M, x, c, imin);
    S.Dnode = (ln - bn) / (ln + bn);
    S.Dext = (S.Lext - S.Bext) / (S.Lext + S.Bext);
    // concave edges (wrinkles or dimples)
    std::map<std::pair<int, int>, int> e;
    long ne = 0, nc = 0;
    for (size_t t = 0; t < M.tri.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            auto key = std::minmax(M.tri[t][k], M.tri[t][(k + 1) % 3]);
            auto it = e.find(key);
            if (it == e.end()) {
                e[key] = t;
                continue;
            }
            const auto &T1 = M.tri[it->second], &T2 = M.tri[t];
            Vec3 n1 = cross(x[T1[1]] - x[T1[0]], x[T1[2]] - x[T1[0]]),
                 n2 = cross(x[T2[1]] - x[T2[0]], x[T2[2]] - x[T2[0]]);
            Vec3 d = (1. / 3) * (x[T2[0]] + x[T2[1]] + x[T2[2]] - x[T1[0]] - x[T1[1]] - x[T1[2]]);
            double ang = std::atan2(norm(cross(n1, n2)), dot(n1, n2)) * 180 / M_PI;
            ++ne;
            if (dot(n1, d) > 0) {
                if (ang > 1) ++nc;
                S.maxConcaveDeg = std::max(S.maxConcaveDeg, ang);
            }
        }
    S.concave = double(nc) / ne;
    return S;
}

// ---------------------------------------------------------------- time integration
static void rkcStep(Solver& S, VecN& x, const VecN& f0, double h, int s) {
    const int n = x.size();
    const double eps = 2. / 13, w0 = 1 + eps / (s * s);
    std::vector<double> T(s + 1), d(s + 1), dd(s + 1), b(s + 1), a(s + 1);
    T[0] = 1;
    T[1] = w0;
    d[0] = 0;
    d[1] = 1;
    dd[0] = dd[1] = 0;
    for (int j = 2; j <= s; ++j) {
        T[j] = 2 * w0 * T[j - 1] - T[j - 2];
        d[j] = 2 * T[j - 1] + 2 * w0 * d[j - 1] - d[j - 2];
        dd[j] = 4 * d[j - 1] + 2 * w0 * dd[j - 1] - dd[j - 2];
    }
    const double w1 = d[s] / dd[s];
    for (int j = 2; j <= s; ++j) b[j] = dd[j] / (d[j] * d[j]);
    b[0] = b[1] = b[2];
    for (int j = 0; j <= s; ++j) a[j] = 1 - b[j] * T[j];
    VecN y0 = x, y1(n), y2(n), f;
    for (int i = 0; i < n; ++i) y1[i] = y0[i] + (b[1] * w1 * h) * f0[i];
    VecN ym = y0;
    for (int j = 2; j <= s; ++j) {
        double mu = 2 * b[j] * w0 / b[j - 1], nu = -b[j] / b[j - 2], mt = 2 * b[j] * w1 / b[j - 1],
               ga = -a[j - 1] * mt;
        S.rhs(y1, f);
        for (int i = 0; i < n; ++i)
            y2[i] = (1 - mu - nu) * y0[i] + mu * y1[i] + nu * ym[i] + (mt * h) * f[i] + (ga * h) * f0[i];
        ym = y1;
        y1 = y2;
    }
    x = y1;
}

static int run(Solver& S, double dt, double tend, const char* tag) {
    S.Gs = 1 / (3 * S.Ca);
    VecN x = S.M.x0, u;
    auto t0 = std::chrono::steady_clock::now();
    int every = std::max(1L, std::lround(0.5 / dt));
    if (std::fabs(every * dt - 0.5) > 1e-9) every = std::max(1L, std::lround(1 / dt));
    const int nstep = std::lround(tend / dt), rhoEvery = std::max(1L, std::lround(0.5 / dt));
    double vol0 = measure(S.M, x).volume, rho = 0;
    std::printf(
        "# run %s Ca_Es %g nodes %zu triangles %zu dt %g mass %d full %d single %d bend %g near %g mid %g "
        "targets %zu\n",
        tag, S.Ca, x.size(), S.M.tri.size(), dt, S.consistentMass, S.full, S.singleFar, S.kBend, S.nearFactor,
        S.midFactor, S.target.size());
    std::printf(
        "# tag Ca nodes dt strain D_volume D_extent D_node incl L M B volume_drift area least_tension/Gs "
        "compressed_fraction concave_fraction max_concave_deg stages evals wall_s\n");
    int stages = 2;
    for (int k = 0; k <= nstep; ++k) {
        if (k % every == 0 || k == nstep) {
            Shape s = measure(S.M, x);
            double neg, lt = leastTension(S.M, x, &neg);
            std::printf(
                "%s %g %zu %g %.4f %.6f %.6f %.6f %.3f %.5f %.5f %.5f %.3e %.5f %.4f %.4f %.4f %.2f %d %ld "
                "%.1f\n",
                tag, S.Ca, x.size(), dt, k * dt, s.D, s.Dext, s.Dnode, s.incl, s.axis[2], s.axis[1],
                s.axis[0], s.volume / vol0 - 1, s.area, lt, neg, s.concave, s.maxConcaveDeg, stages, S.evals,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
            std::fflush(stdout);
            if (!(s.D < 0.95)) {
                std::printf("# stopped: not a number or collapsed\n");
                return 1;
            }
        }
        if (k == nstep) break;
        S.rhs(x, u);
        if (k % rhoEvery == 0) {
            rho = 1.25 * S.spectralRadius(x, u, k == 0 ? 30 : 4);
            stages = std::max(2, int(std::ceil(std::sqrt(1 + 1.5 * dt * rho / (1 - 2 * (2. / 13) / 15)))));
        }
        rkcStep(S, x, u, dt, stages);
    }
    return 0;
}

// ---------------------------------------------------------------- validation
static void tests() {
    std::printf("== 1 single layer on the sphere: uniform traction (u = 2/3 f) and Y2 fields\n");
    // second known answer: f = n_x ... traction e = (y,x,0)/a (linear field E.n): in the sphere u = c E.x with
    // c = 1/5 (a = mu = 1): the jump of traction of (E.x inside | decaying stresslet+quadrupole outside) is 5 mu E.n
    for (int level = 2; level <= 5; ++level)
        for (int q = 0; q <= (level < 5 ? 2 : 1); ++q) {
            Solver S;
            S.M = icosphere(level, false);
            S.shear = false;
            S.setQuadrature(q);
            S.full = level < 5;
            S.setSymmetry();
            VecN f(S.M.x0.size()), u;
            double e1 = 0, m1 = 0, e2 = 0;
            if (S.full) {
                for (auto& v : f) v = {1, 0, 0};
                S.velocity(S.M.x0, f, u);
                for (auto& v : u) {
                    m1 += v[0] / u.size();
                    e1 = std::max(e1, norm(v - Vec3{2. / 3, 0, 0}));
                }
            }
            for (size_t i = 0; i < f.size(); ++i) f[i] = {S.M.x0[i][1], S.M.x0[i][0], 0};
            S.velocity(S.M.x0, f, u);
            double c = 0, n2 = 0;
            for (size_t i = 0; i < f.size(); ++i) {
                c += dot(u[i], f[i]);
                n2 += dot(f[i], f[i]);
                e2 = std::max(e2, norm(u[i] - 0.2 * f[i]));
            }
            std::printf(
                "nodes %zu quad %d uniform: mean u_x %.6f (2/3) max err %.2e | E.n: coefficient %.6f (0.2) "
                "max err %.2e\n",
                f.size(), q, m1, e1, c / n2, e2);
        }
    std::printf("== 2 membrane force against finite differences of the energy\n");
    {
        Mesh M = icosphere(2, true);
        VecN x = M.x0, F;
        std::mt19937 g(3);
        std::normal_distribution<double> N;
        for (auto& v : x)
            v = Vec3{1.3 * v[0] + 0.3 * v[1], 0.9 * v[1], 0.8 * v[2]} + 0.02 * Vec3{N(g), N(g), N(g)};
        membrane(M, x, 1.0, &F);
        double err = 0, big = 0, h = 1e-5;
        Vec3 tot{0, 0, 0}, tor{0, 0, 0};
        for (size_t i = 0; i < x.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                VecN y = x;
                y[i][k] += h;
                double ep = membrane(M, y, 1.0, nullptr);
                y[i][k] -= 2 * h;
                double em = membrane(M, y, 1.0, nullptr);
                err = std::max(err, std::fabs(-(ep - em) / (2 * h) - F[i][k]));
                big = std::max(big, std::fabs(F[i][k]));
            }
        for (size_t i = 0; i < x.size(); ++i) {
            tot = tot + F[i];
            tor = tor + cross(x[i], F[i]);
        }
        {
            VecN Fb(x.size(), {0, 0, 0});
            bending(M, x, 1.0, &Fb);
            double eb = 0, bb = 0;
            for (size_t i = 0; i < x.size(); ++i)
                for (int k = 0; k < 3; ++k) {
                    VecN y = x;
                    y[i][k] += h;
                    double ep = bending(M, y, 1.0, nullptr);
                    y[i][k] -= 2 * h;
                    double em = bending(M, y, 1.0, nullptr);
                    eb = std::max(eb, std::fabs(-(ep - em) / (2 * h) - Fb[i][k]));
                    bb = std::max(bb, std::fabs(Fb[i][k]));
                }
            std::printf("(optional bending) max |F_fd - F| %.2e of max |F| %.3f\n", eb, bb);
        }
        std::printf("max |F_fd - F| %.2e of max |F| %.3f; net force %.1e net torque %.1e\n", err, big,
                    norm(tot), norm(tor));
    }
    std::printf(
        "== 3 flat patch, uniaxial stretch: force per undeformed width Gs (l - 1/l^2), lateral stretch "
        "l^-1/2\n");
    for (double lam : {1.1, 1.5, 2.0}) {
        Mesh M;
        const int n = 6;
        std::mt19937 g(5);
        std::uniform_real_distribution<double> U(-0.25, 0.25);
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                double X = i, Y = j;
                if (i > 0 && i < n && j > 0 && j < n) {
                    X += U(g);
                    Y += U(g);
                }
                M.x0.push_back({X / n, Y / n, 0});
            }
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
                if ((i + j) & 1) {
                    M.tri.push_back({a, b, c});
                    M.tri.push_back({b, d, c});
                } else {
                    M.tri.push_back({a, b, d});
                    M.tri.push_back({a, d, c});
                }
            }
        M.finish();
        VecN x = M.x0, F, v(x.size(), {0, 0, 0});
        for (auto& p : x) p[0] *= lam;
        for (int it = 0; it < 20000; ++it) {  // damped relaxation; ends fixed in x only, node 0 fixed in y
            membrane(M, x, 1.0, &F);
            for (size_t i = 0; i < x.size(); ++i) {
                int col = i % (n + 1);
                if (col == 0 || col == n) F[i][0] = 0;
                if (i == 0) F[i][1] = 0;
                F[i][2] = 0;
                v[i] = 0.97 * v[i] + 0.05 * F[i];
                x[i] = x[i] + v[i];
            }
        }
        membrane(M, x, 1.0, &F);
        double P = 0;
        for (int j = 0; j <= n; ++j) P -= F[j * (n + 1) + n][0];
        double lat = x[n * (n + 1)][1] - x[0][1];
        std::printf("l %.2f force %.8f (%.8f) lateral %.8f (%.8f)\n", lam, P, lam - 1 / (lam * lam), lat,
                    1 / std::sqrt(lam));
    }
    std::printf("== 4 inertia-ellipsoid measure of an exact ellipsoid 1.6 x 0.7 x 0.9 turned by 25 deg\n");
    for (int level = 3; level <= 5; ++level) {
        Mesh M = icosphere(level, true);
        VecN x = M.x0;
        double c = std::cos(25 * M_PI / 180), s = std::sin(25 * M_PI / 180);
        for (auto& v : x) {
            double p = 1.6 * v[0], q = 0.7 * v[1];
            v = {c * p - s * q, s * p + c * q, 0.9 * v[2]};
        }
        Shape S = measure(M, x);
        std::printf("nodes %zu D_volume %.6f D_extent %.6f D_node %.6f (%.6f) incl %.3f (25)\n", x.size(),
                    S.D, S.Dext, S.Dnode, 0.9 / 2.3, S.incl);
    }
}

int main(int argc, char** argv) {
    Solver S;
    int level = 3, quad = 0;
    double dt = 0.02, tend = 8;
    const char* tag = "run";
    for (int i = 1; i < argc; ++i) {
        std::string a = argv[i];
        if (a == "--test") {
            tests();
            return 0;
        }
        if (i + 1 >= argc) {
            std::fprintf(stderr, "value missing after %s\n", argv[i]);
            return 2;
        }
        const char* v = argv[++i];
        if (a == "--ca")
            S.Ca = std::atof(v);
        else if (a == "--level")
            level = std::atoi(v);
        else if (a == "--dt")
            dt = std::atof(v);
        else if (a == "--tend")
            tend = std::atof(v);
        else if (a == "--quad")
            quad = std::atoi(v);
        else if (a == "--mass")
            S.consistentMass = std::atoi(v);
        else if (a == "--full")
            S.full = std::atoi(v);
        else if (a == "--tag")
            tag = v;
        else if (a == "--single")
            S.singleFar = std::atoi(v);
        else if (a == "--bend")
            S.kBend = std::atof(v);
        else {
            std::fprintf(stderr, "unknown option %s\n", a.c_str());
            return 2;
        }
    }
    S.M = icosphere(level, true);
    S.setQuadrature(quad);
    S.setSymmetry();
    return run(S, dt, tend, tag);
}
