// A cell alone in Python: relaxed, stretched, measured.
#include <fmt/format.h>

#include "apps/cell_builder.hpp"
#include "apps/membrane_task.hpp"
#include "apps/python/bindings.hpp"
#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::python {
namespace {

using apps::attojoule_per_unit, apps::piconewton;

/// One cell of a case.
class Membrane {
  public:
    Membrane(const apps::Case& c, std::size_t cell)
        : grip_(c.membrane.grip),
          options_{.tolerance = c.membrane.tolerance * piconewton},
          batch_(build(c, cell, options_)) {}

    py::dict relax() {
        membrane::RelaxResult result;
        {
            const py::gil_scoped_release release;
            result = membrane::relax(batch_, options_);
        }
        py::dict values;
        values["iterations"] = result.iterations;
        values["largest_force_pN"] = result.largest_force / piconewton;
        values["energy_aJ"] = result.energy * attojoule_per_unit;
        return values;
    }

    py::dict stretch(const std::vector<double>& forces) {
        std::vector<membrane::StretchPoint> points;
        {
            const py::gil_scoped_release release;
            points = membrane::stretch(batch_, forces, options_, grip_);
        }
        std::vector<std::vector<double>> rows;
        for (const membrane::StretchPoint& p : points)
            rows.push_back({p.force_pN, p.axial_um, p.transverse_um, p.area_error, p.volume_error});
        return to_dict({"force_pN", "axial_um", "transverse_um", "area_error", "volume_error"}, rows);
    }

    [[nodiscard]] py::array_t<double> nodes() const { return to_array(batch_.positions(0)); }
    void set_nodes(const py::array_t<double, py::array::c_style | py::array::forcecast>& nodes) {
        const auto n = static_cast<py::ssize_t>(batch_.vertices());
        if (nodes.ndim() != 2 || nodes.shape(0) != n || nodes.shape(1) != 3)
            throw InputError("the array of nodes", fmt::format("its shape must be ({}, 3)", n),
                             "Change what `nodes` gave and hand it back");
        std::vector<Vec3d> positions;
        for (py::ssize_t i = 0; i < n; ++i)
            positions.push_back({nodes.at(i, 0), nodes.at(i, 1), nodes.at(i, 2)});
        batch_.set_positions(0, positions);
    }
    [[nodiscard]] py::array_t<int> triangles() const { return to_array(batch_.topology().triangles()); }

    py::array_t<double> forces() {
        batch_.compute_forces();
        std::vector<Vec3d> forces = batch_.forces(0);
        for (Vec3d& f : forces) f = 1 / piconewton * f;
        return to_array(forces);
    }

    py::dict energies() {
        batch_.compute_forces();
        const membrane::Energies e = batch_.energies(0);
        py::dict values;
        for (const auto& [name, value] : {std::pair{"volume", e.volume},
                                          {"area", e.area},
                                          {"local_area", e.local_area},
                                          {"bending", e.bending},
                                          {"area_difference", e.area_difference},
                                          {"shear", e.shear},
                                          {"total", e.total()}})
            values[name] = value * attojoule_per_unit;
        return values;
    }

    [[nodiscard]] py::dict measures() const {
        const auto positions = batch_.positions(0);
        const auto& triangles = batch_.topology().triangles();
        const auto moments = membrane::shape_moments(triangles, positions);
        const auto disc = membrane::disc_measures(triangles, positions);
        const auto diameters = membrane::stretch_diameters(positions, moments.centroid);
        py::dict values;
        for (const auto& [name, value] : {std::pair{"area_um2", moments.area},
                                          {"volume_um3", moments.volume},
                                          {"reduced_volume", moments.reduced_volume},
                                          {"diameter_um", disc.diameter},
                                          {"centre_thickness_um", disc.centre_thickness},
                                          {"greatest_thickness_um", disc.greatest_thickness},
                                          {"axial_um", diameters.axial},
                                          {"transverse_um", diameters.transverse}})
            values[name] = value;
        return values;
    }

  private:
    static membrane::Batch build(const apps::Case& c, std::size_t cell,
                                 const membrane::RelaxOptions& options) {
        if (cell >= c.cells.size())
            throw InputError(fmt::format("cell {}", cell),
                             fmt::format("the case has {}, counted from 0", c.cells.size()),
                             "Name one of them");
        const py::gil_scoped_release release;
        const membrane::Cell built = apps::build_cell(c.cells[cell], options);
        membrane::Batch batch(built.topology, built.parameters, built.reference);
        batch.set_positions(0, built.positions);
        return batch;
    }

    membrane::Grip grip_;
    membrane::RelaxOptions options_;
    membrane::Batch batch_;
};

}  // namespace

void bind_membrane(py::module_& m) {
    py::class_<Membrane>(
        m, "Membrane",
        "One cell of a case alone, about the origin with the axis of its disc along z. Lengths in "
        "um, forces in pN, energies in aJ. Arrays are copies.")
        .def(py::init<const apps::Case&, std::size_t>(), py::arg("case"), py::arg("cell") = 0,
             "Builds the cell; a discocyte is relaxed.")
        .def("relax", &Membrane::relax,
             "Moves the nodes to the nearest minimum of the energy. Returns what that took.")
        .def("stretch", &Membrane::stretch, py::arg("forces"),
             "Relaxes the cell and pulls it along x by these forces (pN) in turn, as optical tweezers do. "
             "Returns a "
             "dict of arrays: force_pN, axial_um, transverse_um, area_error, volume_error.")
        .def_property("nodes", &Membrane::nodes, &Membrane::set_nodes,
                      "Positions of the nodes, um, shape (nodes, 3); can be set.")
        .def_property_readonly("triangles", &Membrane::triangles, "Node numbers, shape (triangles, 3).")
        .def_property_readonly("forces", &Membrane::forces, "-grad E at the nodes, pN, shape (nodes, 3).")
        .def_property_readonly("energies", &Membrane::energies, "Energies by term and their total, aJ.")
        .def_property_readonly("measures", &Membrane::measures,
                               "Area, volume, diameters and thicknesses of the shape, names with units.");
}

}  // namespace hemoflux::python
