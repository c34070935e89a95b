// Cases in Python: read, overridden, checked.
#include "apps/case.hpp"

#include "apps/case_check.hpp"
#include "apps/python/bindings.hpp"
#include "apps/run.hpp"

namespace hemoflux::python {
namespace {

using apps::Case;

std::vector<std::string> check(const Case& c) {
    const py::gil_scoped_release release;
    std::vector<std::string> warnings = apps::check_case(c);
    apps::check_run(c);
    return warnings;
}

const char* kind(const Case& c) {
    constexpr const char* names[] = {"coupled", "fluid", "membrane"};
    return names[static_cast<std::size_t>(c.kind)];
}

}  // namespace

void bind_case(py::module_& m) {
    py::class_<Case>(m, "Case", "A case: everything a run needs to know, checked key by key.")
        .def_static("_from_file", &apps::read_case, py::arg("file"), py::arg("overrides"))
        .def_static("_from_text", &apps::parse_case, py::arg("text"), py::arg("name"), py::arg("folder"),
                    py::arg("overrides"))
        .def_readonly("title", &Case::title, "What the case calls itself.")
        .def_property_readonly("kind", &kind, "\"coupled\", \"fluid\" or \"membrane\".")
        .def_readonly("resolved", &Case::resolved,
                      "The case as TOML text with every default filled in; reading it gives an equal case.")
        .def_property_readonly(
            "cells", [](const Case& c) { return c.cells.size(); }, "Number of cells.")
        .def("check", &check,
             "Checks geometry and numbers as `hemoflux run --check` does. Returns warnings; raises "
             "InputError.")
        .def("__repr__",
             [](const Case& c) { return "<hemoflux.Case \"" + c.title + "\" of kind " + kind(c) + ">"; });
}

}  // namespace hemoflux::python
