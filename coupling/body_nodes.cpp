#include "coupling/body_nodes.hpp"

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

struct Arrays {
    double* at[3];
    HEMOFLUX_INLINE Vec3d get(std::size_t i) const { return {at[0][i], at[1][i], at[2][i]}; }
    HEMOFLUX_INLINE void put(std::size_t i, const Vec3d& v) const {
        at[0][i] = v.x;
        at[1][i] = v.y;
        at[2][i] = v.z;
    }
};

Arrays arrays(const exchange::FieldView& v) { return {{v.component[0], v.component[1], v.component[2]}}; }

struct PlaceNode {
    Matrix3 turn;
    Vec3d centre;
    Arrays own, position;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const Vec3d x = own.get(i);
        position.put(i, centre + Vec3d{dot(turn.row[0], x), dot(turn.row[1], x), dot(turn.row[2], x)});
    }
};

struct CopyArea {
    const double* area;
    Arrays to;
    HEMOFLUX_FN void operator()(std::size_t i) const { to.put(i, {area[i], area[i], area[i]}); }
};

struct UniformGain {
    double share;
    const double* area;
    double* gain;
    HEMOFLUX_FN void operator()(std::size_t i) const { gain[i] = share * area[i]; }
};

struct ResponseGain {
    double dt;
    const double *area, *response;
    double* gain;
    HEMOFLUX_FN void operator()(std::size_t i) const { gain[i] = area[i] / (dt * std::fabs(response[i])); }
};

struct Response {
    const double* response;
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t i) const { return {std::fabs(response[i])}; }
};

struct SumNode {
    Vec3d centre;
    const double* gain;
    Arrays position, u, force;
    HEMOFLUX_FN NodeSums operator()(std::size_t i) const {
        const Vec3d r = position.get(i) - centre, v = u.get(i), f = force.get(i);
        const double k = gain[i];
        return {k,
                k * r,
                {k * r.x * r.x, k * r.y * r.y, k * r.z * r.z, k * r.x * r.y, k * r.y * r.z, k * r.z * r.x},
                k * v,
                k * cross(r, v),
                f,
                cross(r, f)};
    }
};

/// U + Omega x r of a node.
struct Rigid {
    Vec3d centre, velocity, spin;
    HEMOFLUX_INLINE Vec3d operator()(const Vec3d& position) const {
        return velocity + cross(spin, position - centre);
    }
};

struct CorrectNode {
    Rigid rigid;
    const double* gain;
    Arrays position, u, force, increment;
    bool add;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const Vec3d change = gain[i] * (rigid(position.get(i)) - u.get(i));
        force.put(i, force.get(i) + change);
        increment.put(i, add ? increment.get(i) + change : change);
    }
};

struct CombineNode {
    double factor;
    Arrays base, to;
    HEMOFLUX_FN void operator()(std::size_t i) const { to.put(i, base.get(i) + factor * to.get(i)); }
};

struct SlipNode {
    Rigid rigid;
    const double* area;
    Arrays position, u;
    HEMOFLUX_FN SlipSums operator()(std::size_t i) const {
        const Vec3d d = rigid(position.get(i)) - u.get(i);
        return {area[i], area[i] * dot(d, d)};
    }
};

exchange::FieldView view(exchange::Buffer<double> (&b)[3]) {
    return {{b[0].data(), b[1].data(), b[2].data()}, b[0].size()};
}

Rigid rigid_of(const BodyState& s) { return {s.centre, s.velocity, s.angular_velocity}; }

}  // namespace

struct BodyNodes::Scratch {
    exchange::Reduction<NodeSums> sums;
    exchange::Reduction<SlipSums> slip;
    exchange::Reduction<exchange::Maximum> maximum;
};

BodyNodes::BodyNodes(const BodySurface& surface)
    : area_(surface.areas), gain_(surface.areas.size()), scratch_(new Scratch) {
    std::vector<double> x[3];
    for (const Vec3d& v : surface.nodes) {
        x[0].push_back(v.x);
        x[1].push_back(v.y);
        x[2].push_back(v.z);
    }
    for (int q = 0; q < 3; ++q) {
        own_[q] = exchange::Buffer<double>(x[q]);
        for (auto* set : {&position_[q], &force_[q], &velocity_[q], &increment_[q]})
            *set = exchange::Buffer<double>(size());
    }
}

BodyNodes::~BodyNodes() = default;

exchange::FieldView BodyNodes::positions() { return view(position_); }
exchange::FieldView BodyNodes::forces() { return view(force_); }
exchange::FieldView BodyNodes::velocities() { return view(velocity_); }
exchange::FieldView BodyNodes::increments() { return view(increment_); }

void BodyNodes::place(const BodyState& state) {
    exchange::for_each_index(
        size(), PlaceNode{rotation(state.orientation), state.centre, arrays(view(own_)), arrays(positions())},
        exchange::Cost::cheap);
}

void BodyNodes::areas_to_increments() {
    exchange::for_each_index(size(), CopyArea{area_.data(), arrays(increments())}, exchange::Cost::cheap);
}

void BodyNodes::set_uniform_gains(double share) {
    exchange::for_each_index(size(), UniformGain{share, area_.data(), gain_.data()}, exchange::Cost::cheap);
}

void BodyNodes::set_gains_from_response(double dt) {
    exchange::for_each_index(size(), ResponseGain{dt, area_.data(), velocity_[0].data(), gain_.data()},
                             exchange::Cost::cheap);
}

double BodyNodes::largest_response() {
    return scratch_->maximum.sum(size(), Response{velocity_[0].data()}).value;
}

NodeSums BodyNodes::sums(const Vec3d& centre, const exchange::FieldView& u) {
    return scratch_->sums.sum(
        size(), SumNode{centre, gain_.data(), arrays(positions()), arrays(u), arrays(forces())});
}

void BodyNodes::correct(const BodyState& state, const exchange::FieldView& u, bool add) {
    exchange::for_each_index(size(),
                             CorrectNode{rigid_of(state), gain_.data(), arrays(positions()), arrays(u),
                                         arrays(forces()), arrays(increments()), add},
                             exchange::Cost::cheap);
}

void BodyNodes::combine(const exchange::FieldView& base, double factor) {
    exchange::for_each_index(size(), CombineNode{factor, arrays(base), arrays(velocities())},
                             exchange::Cost::cheap);
}

SlipSums BodyNodes::slip(const BodyState& state, const exchange::FieldView& u) {
    return scratch_->slip.sum(size(),
                              SlipNode{rigid_of(state), area_.data(), arrays(positions()), arrays(u)});
}

}  // namespace hemoflux::coupling
