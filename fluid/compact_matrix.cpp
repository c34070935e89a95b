#include "fluid/compact_matrix.hpp"

#include <algorithm>

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/face_jacobian.hpp"
#include "fluid/factor_rows.hpp"
#include "meshing/face_frame.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::lanes;
using exchange::load;
using exchange::Pack;

/// Fields of face data, one array after the other.
enum Field : std::size_t {
    normal = 0,
    tangent1 = 3,
    tangent2 = 6,
    weight = 9,
    delta = 10,
    viscosity = 11,
    area = 12
};
constexpr std::size_t fields = 13;

/// Reads the data of one face or of a pack of consecutive ones.
template <class Value>
HEMOFLUX_INLINE JacobianFace<Value> face_at(const double* data, std::size_t count, std::size_t f) {
    JacobianFace<Value> j;
    for (std::size_t a = 0; a < 3; ++a) {
        j.n[a] = load<Value>(data + (normal + a) * count + f);
        j.t1[a] = load<Value>(data + (tangent1 + a) * count + f);
        j.t2[a] = load<Value>(data + (tangent2 + a) * count + f);
    }
    j.weight_left = load<Value>(data + weight * count + f);
    j.delta = load<Value>(data + delta * count + f);
    j.nu = load<Value>(data + viscosity * count + f);
    return j;
}

/// Density and velocity of the cells index[0], index[1], ..., one a lane.
template <class Value>
HEMOFLUX_INLINE void gather_state(const double* q, std::size_t cells, const std::uint32_t* index,
                                  Value (&v)[4]) {
    double lane[4][lanes<Value>];
    for (std::size_t l = 0; l < lanes<Value>; ++l) {
        const double rho = q[index[l]];
        lane[0][l] = rho;
        for (std::size_t c = 1; c < 4; ++c) lane[c][l] = q[c * cells + index[l]] / rho;
    }
    for (int c = 0; c < 4; ++c) v[c] = load<Value>(lane[c]);
}

/// Blocks of fill start from zero.
struct Clear {
    float* block;
    HEMOFLUX_FN void operator()(std::size_t i) const { block[i] = 0; }
};

/// Off-diagonal blocks of a pack of interior faces.
struct InteriorBlocks {
    const double *data, *q, *volume;
    const std::uint32_t *left, *right, *left_right, *right_left;
    std::size_t count, cells;
    double gamma;
    float* block;

    HEMOFLUX_FN void operator()(std::size_t pack) const {
        const std::size_t f = pack * lanes<Pack>;
        const FaceJacobian<Pack> jacobian{face_at<Pack>(data, count, f), gamma};
        Pack state[2][4], phi[2][4];
        for (int side = 0; side < 2; ++side) {
            gather_state(q, cells, (side == 0 ? left : right) + f, state[side]);
            jacobian.turn(state[side], phi[side]);
        }
        for (int side = 0; side < 2; ++side) {
            Pack d[4][4];
            jacobian.derivative(side, phi[0], phi[1], d);
            jacobian.conserved(phi[side], d);
            // dF/dQ_right belongs to (left, right) with +S/V_left, dF/dQ_left to (right, left) with -S/V_right.
            const std::uint32_t* slot = (side == 0 ? right_left : left_right) + f;
            const std::uint32_t* row = (side == 0 ? right : left) + f;
            double factor[lanes<Pack>];
            for (std::size_t l = 0; l < lanes<Pack>; ++l)
                factor[l] = (side == 0 ? -1 : 1) * data[area * count + f + l] / volume[row[l]];
            for (int i = 0; i < 4; ++i)
                for (int k = 0; k < 4; ++k) {
                    double value[lanes<Pack>];
                    exchange::store(value, d[i][k]);
                    for (std::size_t l = 0; l < lanes<Pack>; ++l)
                        if (slot[l] != CompactPattern::none)
                            block[16 * std::size_t{slot[l]} + static_cast<std::size_t>(4 * i + k)] =
                                static_cast<float>(factor[l] * value[l]);
                }
        }
    }
};

/// Derivative of the flux through one border face with respect to its cell; the ghost follows the cell.
struct BorderBlocks {
    const double *data, *offset, *q, *volume;
    const std::uint32_t* cell;
    /// [face][5]: signs of the ghost's rho, u_n, u_t, u_t in the face's frame, and whether its mass flux is given.
    const signed char* sign;
    std::size_t count, cells;
    double gamma;
    float* block;

    HEMOFLUX_FN void operator()(std::size_t b) const {
        const FaceJacobian<double> jacobian{face_at<double>(data, count, b), gamma};
        double state[4], phi[4], shift[4], ghost[4], d[4][4], g[4][4];
        gather_state(q, cells, cell + b, state);
        jacobian.turn(state, phi);
        for (int c = 0; c < 4; ++c) state[c] = offset[4 * b + static_cast<std::size_t>(c)];
        jacobian.turn(state, shift);
        const signed char* s = sign + 5 * b;
        for (int c = 0; c < 4; ++c) ghost[c] = shift[c] + s[c] * phi[c];
        jacobian.derivative(0, phi, ghost, d);
        jacobian.derivative(1, phi, ghost, g);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k) d[i][k] = i == 0 && s[4] ? 0 : d[i][k] + s[k] * g[i][k];
        jacobian.conserved(phi, d);
        const double factor = data[area * count + b] / volume[cell[b]];
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k)
                block[16 * b + static_cast<std::size_t>(4 * i + k)] = static_cast<float>(factor * d[i][k]);
    }
};

/// Diagonal of a row: I/dt, and minus what its neighbours' rows have of it, weighted with the volumes.
struct Diagonal {
    const std::uint32_t *cell, *first, *column, *reverse, *first_border;
    const double *volume, *dt;
    const float *block, *border_block;
    float* diagonal;

    HEMOFLUX_FN void operator()(std::size_t row) const {
        float d[16];
        for (int e = 0; e < 16; ++e) d[e] = 0;
        const double own = volume[cell[row]];
        for (std::uint32_t p = first[row]; p < first[row + 1]; ++p) {
            const auto ratio = static_cast<float>(volume[cell[column[p]]] / own);
            const float* b = block + 16 * std::size_t{reverse[p]};
            for (int e = 0; e < 16; ++e) d[e] -= ratio * b[e];
        }
        for (std::uint32_t p = first_border[row]; p < first_border[row + 1]; ++p)
            for (int e = 0; e < 16; ++e)
                d[e] += border_block[16 * std::size_t{p} + static_cast<std::size_t>(e)];
        for (int c = 0; c < 4; ++c) d[5 * c] += static_cast<float>(1 / dt[cell[row]]);
        for (int e = 0; e < 16; ++e) diagonal[16 * row + static_cast<std::size_t>(e)] = d[e];
    }
};

/// Rows of a level that make waking the threads worth while.
exchange::Cost cost(std::size_t rows) { return rows < 256 ? exchange::Cost::cheap : exchange::Cost::heavy; }

/// Data of the faces `numbers`, padded to `count`.
std::vector<double> face_data(const std::vector<CompactFace>& faces,
                              const std::vector<std::uint32_t>& numbers, std::size_t count) {
    std::vector<double> data(fields * count, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const CompactFace& f = faces[numbers[std::min(i, numbers.size() - 1)]];
        const meshing::FaceFrame frame = meshing::face_frame(f.normal);
        const double values[fields] = {frame.normal.x,
                                       frame.normal.y,
                                       frame.normal.z,
                                       frame.tangent1.x,
                                       frame.tangent1.y,
                                       frame.tangent1.z,
                                       frame.tangent2.x,
                                       frame.tangent2.y,
                                       frame.tangent2.z,
                                       f.weight_left,
                                       f.delta,
                                       f.nu,
                                       f.area};
        for (std::size_t k = 0; k < fields; ++k) data[k * count + i] = values[k];
    }
    return data;
}

}  // namespace

CompactMatrix::CompactMatrix(const CompactModel& model, const std::vector<double>& volume,
                             std::optional<std::uint32_t> fill)
    : cells_(volume.size()), gamma_(model.gamma) {
    const CompactPattern pattern =
        make_compact_pattern(cells_, model.faces, fill.value_or(default_fill(cells_, model.faces)));
    level_ = pattern.level;
    cell_ = kept(pattern.cell);
    first_ = kept(pattern.first);
    upper_ = kept(pattern.upper);
    column_ = kept(pattern.column);
    reverse_ = kept(pattern.reverse);
    first_border_ = kept(pattern.first_border);
    volume_ = kept(volume);
    set_faces(model, pattern);
    block_ = kept(std::vector<float>(16 * pattern.column.size()));
    diagonal_ = kept(std::vector<float>(16 * cells_));
    border_block_ = kept(std::vector<float>(16 * border_count_));
    work_ = kept(std::vector<float>(4 * cells_));
}

void CompactMatrix::set_faces(const CompactModel& model, const CompactPattern& pattern) {
    interior_ = exchange::round_up(pattern.interior.size(), lanes<Pack>);
    border_count_ = pattern.border.size();
    std::vector<std::uint32_t> left(interior_, 0), right(interior_, 0),
        forward(interior_, CompactPattern::none), back(interior_, CompactPattern::none);
    for (std::size_t i = 0; i < pattern.interior.size(); ++i) {
        left[i] = model.faces[pattern.interior[i]].left;
        right[i] = model.faces[pattern.interior[i]].right;
        forward[i] = pattern.left_right[i];
        back[i] = pattern.right_left[i];
    }
    left_ = kept(left), right_ = kept(right);
    left_right_ = kept(forward), right_left_ = kept(back);
    face_ = kept(face_data(model.faces, pattern.interior, interior_));
    border_face_ = kept(face_data(model.faces, pattern.border, border_count_));
    std::vector<std::uint32_t> border_cell;
    std::vector<signed char> sign;
    std::vector<double> offset;
    for (const std::uint32_t number : pattern.border) {
        const CompactFace& f = model.faces[number];
        border_cell.push_back(f.left);
        const bool given = f.velocity == VelocityCondition::given,
                   mirror = f.velocity == VelocityCondition::symmetry;
        const signed char tangential = given ? -1 : 1;
        const signed char normal_sign = given || mirror ? -1 : 1;
        const signed char density = f.density == DensityCondition::given ? -1 : 1;
        sign.insert(sign.end(), {density, normal_sign, tangential, tangential,
                                 static_cast<signed char>(given || mirror)});
        offset.insert(offset.end(), f.offset, f.offset + 4);
    }
    border_cell_ = kept(border_cell);
    border_sign_ = kept(sign);
    border_offset_ = kept(offset);
}

void CompactMatrix::assemble(const double* q, const double* dt) {
    exchange::for_each_index(block_.size(), Clear{block_.data()});
    exchange::for_each_index(
        interior_ / lanes<Pack>,
        InteriorBlocks{face_.data(), q, volume_.data(), left_.data(), right_.data(), left_right_.data(),
                       right_left_.data(), interior_, cells_, gamma_, block_.data()});
    exchange::for_each_index(
        border_count_,
        BorderBlocks{border_face_.data(), border_offset_.data(), q, volume_.data(), border_cell_.data(),
                     border_sign_.data(), border_count_, cells_, gamma_, border_block_.data()});
    exchange::for_each_index(
        cells_, Diagonal{cell_.data(), first_.data(), column_.data(), reverse_.data(), first_border_.data(),
                         volume_.data(), dt, block_.data(), border_block_.data(), diagonal_.data()});
}

void CompactMatrix::factor(const double* q, const double* dt) {
    assemble(q, dt);
    for (std::size_t l = 0; l + 1 < level_.size(); ++l) {
        const std::size_t rows = level_[l + 1] - level_[l];
        exchange::for_each_index(rows,
                                 FactorRow{{level_[l], cell_.data(), first_.data(), upper_.data(),
                                            column_.data(), block_.data(), diagonal_.data()}},
                                 cost(rows));
    }
}

void CompactMatrix::solve(const float* r, const double (&scale)[4], double* x) {
    const LevelKernel level{
        0, cell_.data(), first_.data(), upper_.data(), column_.data(), block_.data(), diagonal_.data()};
    ForwardRow forward{level, r, {}, cells_, work_.data()};
    for (int c = 0; c < 4; ++c) forward.scale[c] = static_cast<float>(1 / scale[c]);
    BackwardRow backward{level, cells_, work_.data(), x};
    for (std::size_t l = 0; l + 1 < level_.size(); ++l) {
        forward.begin = level_[l];
        exchange::for_each_index(level_[l + 1] - level_[l], forward, cost(level_[l + 1] - level_[l]));
    }
    for (std::size_t l = level_.size() - 1; l-- > 0;) {
        backward.begin = level_[l];
        exchange::for_each_index(level_[l + 1] - level_[l], backward, cost(level_[l + 1] - level_[l]));
    }
}

}  // namespace hemoflux::fluid
