// Simulations in Python.
#include <algorithm>
#include <memory>

#include "apps/python/bindings.hpp"
#include "apps/python/simulation.hpp"

namespace hemoflux::python {
namespace {

using apps::Case;

/// Without Python's lock, so that other threads of the caller go on.
template <class Work>
decltype(auto) unlocked(const Work& work) {
    const py::gil_scoped_release release;
    return work();
}

/// In small bites: between two of them Python may handle Ctrl-C.
void step(Simulation& s, long long steps) {
    constexpr long long bite = 25;
    do {
        const long long some = std::min(steps, bite);
        unlocked([&] { s.advance(some); });
        steps -= some;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } while (steps > 0);
}

std::vector<py::ssize_t> shape(const Simulation& s) {
    const auto n = s.shape();
    return {n.begin(), n.end()};
}

py::dict observe(Simulation& s) {
    const std::vector<double>& row = unlocked([&]() -> const std::vector<double>& { return s.observe(); });
    py::dict values;
    for (std::size_t i = 0; i < row.size(); ++i) values[py::str(s.columns()[i])] = row[i];
    return values;
}

}  // namespace

void bind_simulation(py::module_& m) {
    py::class_<Simulation>(
        m, "Simulation",
        "A coupled or fluid case that is advanced step by step, in memory. Lengths in um, times in "
        "s, velocities in um/s. Arrays are copies; those of the fluid have the shape (z, y, x) of "
        "the grid, or (cells) on an unstructured mesh.")
        .def(
            py::init([](const Case& c) { return unlocked([&] { return std::make_unique<Simulation>(c); }); }),
            py::arg("case"), "Sets the case up at t = 0; cells are relaxed first.")
        .def_static(
            "from_folder",
            [](const std::filesystem::path& folder) {
                return unlocked([&] { return Simulation::from_folder(folder); });
            },
            py::arg("folder"), "The state of the last checkpoint in the output folder of a run.")
        .def("step", &step, py::arg("steps") = 1,
             "Advances by so many steps. Raises NumericalError when the state is no longer sound.")
        .def_property_readonly("case", &Simulation::input, "What is being run.")
        .def_property_readonly("steps", &Simulation::done, "Steps done.")
        .def_property_readonly("planned_steps", &Simulation::planned, "Steps to the end that the case names.")
        .def_property_readonly("time", &Simulation::time_s, "Time, s.")
        .def_property_readonly("strain", &Simulation::strain, "Shear rate times time; nan without one.")
        .def_property_readonly(
            "velocity", [](const Simulation& s) { return to_array(s.velocity(), shape(s)); },
            "Velocity of the fluid, um/s, shape (z, y, x, 3).")
        .def_property_readonly(
            "density", [](const Simulation& s) { return to_array(s.density(), shape(s)); },
            "Density of the fluid, kg/m^3, shape (z, y, x).")
        .def_property_readonly(
            "centres", [](const Simulation& s) { return to_array(s.centres(), shape(s)); },
            "Centres of the fluid's cells, um, shape (z, y, x, 3).")
        .def_property_readonly("cells", &Simulation::cells, "Number of membrane cells.")
        .def(
            "nodes", [](const Simulation& s, std::size_t cell) { return to_array(s.nodes(cell)); },
            py::arg("cell") = 0, "Positions of a membrane's nodes, um, shape (nodes, 3); not wrapped.")
        .def(
            "forces", [](Simulation& s, std::size_t cell) { return to_array(s.forces(cell)); },
            py::arg("cell") = 0, "Forces of a membrane on its nodes, pN, shape (nodes, 3).")
        .def(
            "triangles", [](const Simulation& s, std::size_t cell) { return to_array(s.triangles(cell)); },
            py::arg("cell") = 0, "Triangles of a membrane, node numbers, shape (triangles, 3).")
        .def("observe", &observe,
             "The observables now, under their names in history.csv, as a dict; adds a row to `history`.")
        .def_property_readonly(
            "history", [](const Simulation& s) { return to_dict(s.columns(), s.rows()); },
            "What observe() has seen: a dict from each name to its array.");
}

}  // namespace hemoflux::python
