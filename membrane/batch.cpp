#include "membrane/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "exchange/error.hpp"
#include "exchange/memory.hpp"
#include "exchange/pack.hpp"
#include "membrane/area.hpp"
#include "membrane/bending.hpp"
#include "membrane/ring_tables.hpp"
#include "membrane/volume.hpp"

namespace hemoflux::membrane {
namespace {

using exchange::Buffer;

void copy_component(std::vector<double>& host, Buffer<double>& device, std::size_t first) {
    exchange::copy_to_device(device.data() + first, host.data(), host.size() * sizeof(double));
}

std::vector<Vec3d> gather_cell(const Buffer<double>& x, const Buffer<double>& y, const Buffer<double>& z,
                               std::size_t first, std::size_t count) {
    std::vector<double> a(count), b(count), c(count);
    exchange::copy_to_host(a.data(), x.data() + first, count * sizeof(double));
    exchange::copy_to_host(b.data(), y.data() + first, count * sizeof(double));
    exchange::copy_to_host(c.data(), z.data() + first, count * sizeof(double));
    std::vector<Vec3d> result(count);
    for (std::size_t i = 0; i < count; ++i) result[i] = {a[i], b[i], c[i]};
    return result;
}

}  // namespace

Batch::Batch(std::shared_ptr<const Topology> topology, const Parameters& parameters,
             const Reference& reference, std::size_t cells)
    : topology_(std::move(topology)),
      parameters_(parameters),
      cells_(cells),
      stride_(ring_stride(*topology_)),
      x_(cells * stride_),
      y_(cells * stride_),
      z_(cells * stride_),
      fx_(cells * stride_),
      fy_(cells * stride_),
      fz_(cells * stride_),
      neighbour_(neighbour_rows(*topology_)),
      group_degree_(group_degrees(*topology_)),
      degree_(degree_row(*topology_)),
      by_curvature_(cells * stride_),
      by_area_(cells * stride_),
      bend_(cells * stride_ * topology_->max_degree()),
      spring_(cells * stride_ * topology_->max_degree()),
      inverse_normal_(cells * stride_ * topology_->max_degree()),
      device_sums_(cells),
      sums_(cells),
      scratch_(cells, stride_) {
    if (cells == 0)
        throw InputError("a batch of 0 cells", "there is nothing to compute", "Give at least one cell");
    parameters_.check();
    set_reference(reference);
    prepare_bending();
}

void Batch::set_parameters(const Parameters& parameters) {
    parameters.check();
    parameters_ = parameters;
    prepare_law();
    prepare_bending();
}

void Batch::prepare_bending() {
    if (!laplacian_bending() || laplacian_scratch_) return;
    hx_ = Buffer<double>(cells_ * stride_);
    hy_ = Buffer<double>(cells_ * stride_);
    hz_ = Buffer<double>(cells_ * stride_);
    laplacian_sums_ = Buffer<CellSums>(cells_);
    laplacian_scratch_ = std::make_unique<LaplacianScratch>(cells_, stride_);
}

void Batch::prepare_law() {
    const InPlaneLaw law = parameters_.network.law;
    if (stores_triangle_tension(law) && triangle_tension_.size() == 0)
        triangle_tension_ = Buffer<double>(cells_ * stride_ * topology_->max_degree());
    if (!is_continuum(law)) return;
    const RestTriangles rest = rest_triangles(*topology_, reference_.edge_lengths);
    rest_area_ = Buffer<double>(triangle_rows(*topology_, rest.areas, 1, false));
    inverse_rest_area_ = Buffer<double>(triangle_rows(*topology_, rest.areas, 1, true));
    cot_here_ = Buffer<double>(rest.cot_here);
    cot_first_ = Buffer<double>(rest.cot_first);
    cot_second_ = Buffer<double>(rest.cot_second);
}

void Batch::set_reference(const Reference& reference) {
    reference.check(*topology_);
    reference_ = reference;
    const double r = reference.stretch_ratio;
    area0_ = Buffer<double>(triangle_rows(*topology_, reference.triangle_areas, 1, false));
    inverse_area0_ = Buffer<double>(triangle_rows(*topology_, reference.triangle_areas, 1, true));
    contour_ = Buffer<double>(edge_rows(*topology_, reference.edge_lengths, r, false));
    inverse_contour_ = Buffer<double>(edge_rows(*topology_, reference.edge_lengths, r, true));
    prepare_law();
}

double Batch::linear_curvature() const {
    return laplacian_bending() ? -parameters_.bending.local * reference_.curvature : 0;
}

double Batch::linear_area() const {
    return laplacian_bending() ? 0.5 * parameters_.bending.local * reference_.curvature * reference_.curvature
                               : 0;
}

void Batch::set_positions(std::size_t cell, const std::vector<Vec3d>& positions) {
    if (positions.size() != vertices())
        throw std::length_error("Batch::set_positions: wrong number of vertices");
    std::vector<double> a(vertices()), b(vertices()), c(vertices());
    for (std::size_t i = 0; i < vertices(); ++i) {
        a[i] = positions[i].x;
        b[i] = positions[i].y;
        c[i] = positions[i].z;
    }
    copy_component(a, x_, cell * stride_);
    copy_component(b, y_, cell * stride_);
    copy_component(c, z_, cell * stride_);
}

std::vector<Vec3d> Batch::positions(std::size_t cell) const {
    return gather_cell(x_, y_, z_, cell * stride_, vertices());
}

std::vector<Vec3d> Batch::forces(std::size_t cell) const {
    return gather_cell(fx_, fy_, fz_, cell * stride_, vertices());
}

ForceView Batch::view() {
    return {.cells = cells_,
            .stride = stride_,
            .slots = topology_->max_degree(),
            .x = x_.data(),
            .y = y_.data(),
            .z = z_.data(),
            .fx = fx_.data(),
            .fy = fy_.data(),
            .fz = fz_.data(),
            .neighbour = neighbour_.data(),
            .degree = degree_.data(),
            .group_degree = group_degree_.data(),
            .area0 = area0_.data(),
            .inverse_area0 = inverse_area0_.data(),
            .contour = contour_.data(),
            .inverse_contour = inverse_contour_.data(),
            .rest_area = rest_area_.data(),
            .inverse_rest_area = inverse_rest_area_.data(),
            .cot_here = cot_here_.data(),
            .cot_first = cot_first_.data(),
            .cot_second = cot_second_.data(),
            .triangle_tension = triangle_tension_.data(),
            .by_curvature = by_curvature_.data(),
            .by_area = by_area_.data(),
            .bend = bend_.data(),
            .spring = spring_.data(),
            .inverse_normal = inverse_normal_.data(),
            .sums = device_sums_.data(),
            .k_volume = parameters_.constraint.volume,
            .k_area = parameters_.constraint.area,
            .k_local_area = parameters_.constraint.local_area,
            .k_bending = laplacian_bending() ? 0 : parameters_.bending.local,
            .k_area_difference = parameters_.bending.area_difference,
            .linear_curvature = linear_curvature(),
            .linear_area = linear_area(),
            .volume0 = reference_.volume,
            .total_area0 = reference_.area,
            .curvature0 = reference_.curvature,
            .total_curvature0 = reference_.total_curvature,
            .network = parameters_.network,
            .stretch_ratio = reference_.stretch_ratio};
}

LaplacianView Batch::laplacian() {
    return {.k_bending = parameters_.bending.local,
            .hx = hx_.data(),
            .hy = hy_.data(),
            .hz = hz_.data(),
            .sums = laplacian_sums_.data()};
}

bool Batch::try_compute_forces() {
    const ForceView w = view();
    membrane::compute_forces(w, scratch_);
    exchange::copy_to_host(sums_.data(), device_sums_.data(), cells_ * sizeof(CellSums));
    if (laplacian_bending()) {
        laplacian_pass(w, laplacian(), *laplacian_scratch_);
        const std::vector<CellSums> bending = laplacian_sums_.to_host();
        for (std::size_t c = 0; c < cells_; ++c) sums_[c] += bending[c];
    }
    for (const CellSums& s : sums_)
        if (s.overstretched > 0 || s.degenerate > 0) return false;
    if (laplacian_bending()) laplacian_force_pass(w, laplacian());
    return true;
}

void Batch::compute_forces() {
    if (!try_compute_forces()) report_failure();
}

void Batch::report_failure() const {
    for (std::size_t c = 0; c < cells_; ++c) {
        if (sums_[c].degenerate > 0 && !(sums_[c].overstretched > 0))
            throw NumericalError(fmt::format("a vertex of cell {}", c),
                                 "its triangles are so obtuse that its Voronoi area is not positive",
                                 "Take smaller steps, a better mesh, or the Juelicher bending scheme");
        if (!(sums_[c].overstretched > 0)) continue;
        const std::vector<double> lengths = edge_lengths(*topology_, positions(c));
        for (std::size_t e = 0; e < lengths.size(); ++e) {
            const double contour = reference_.stretch_ratio * reference_.edge_lengths[e];
            if (lengths[e] / contour < 1) continue;
            if (is_continuum(parameters_.network.law) && !std::isnan(lengths[e])) continue;
            const Edge& edge = topology_->edges()[e];
            if (std::isnan(lengths[e]))
                throw NumericalError(fmt::format("vertex {} or {} of cell {}", edge.v1, edge.v2, c),
                                     "its position is not a number", "Take smaller steps");
            throw NumericalError(
                fmt::format("spring {} of cell {}, between vertices {} and {}, is {:.6g} um long", e, c,
                            edge.v1, edge.v2, lengths[e]),
                fmt::format("a worm-like chain cannot reach its contour length of {:.6g} um", contour),
                "Take smaller steps, smaller forces, or longer or stiffer springs");
        }
    }
    if (is_continuum(parameters_.network.law))
        throw NumericalError("a triangle", "it is stretched beyond any number", "Take smaller steps");
    throw NumericalError("a spring", "it lies within rounding of its contour length", "Take smaller steps");
}

Energies Batch::energies(std::size_t cell) const {
    const CellSums& s = sums_[cell];
    return {.volume = volume_energy(parameters_.constraint.volume, s.volume, reference_.volume),
            .area = area_energy(parameters_.constraint.area, s.area, reference_.area),
            .local_area = s.local_area_energy,
            .bending = s.helfrich_energy + linear_curvature() * s.total_curvature + linear_area() * s.area,
            .area_difference = area_difference_energy(parameters_.bending.area_difference, s.total_curvature,
                                                      reference_.total_curvature, reference_.area),
            .shear = s.shear_energy};
}

}  // namespace hemoflux::membrane
