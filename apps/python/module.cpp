// The Python module hemoflux._core: errors, threads, and the parts bound elsewhere.
#include <filesystem>

#include "apps/python/bindings.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_core, m) {
    using namespace hemoflux;
    m.doc() = "The compiled part of hemoflux; import hemoflux instead.";
    py::register_exception<InputError>(m, "InputError", PyExc_ValueError).doc() =
        "A case, value or mesh that cannot be run; raised before the first time step.";
    py::register_exception<NumericalError>(m, "NumericalError", PyExc_RuntimeError).doc() =
        "The computation cannot go on: a number is not finite, a spring overstretched, a node lost.";
    py::register_exception<FileError>(m, "FileError", PyExc_OSError).doc() =
        "A file cannot be read or written.";
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const std::filesystem::filesystem_error& error) {
            PyErr_SetString(PyExc_OSError, error.what());
        }
    });
    m.attr("__version__") = HEMOFLUX_VERSION;
    m.attr("backend") = exchange::backend_name();
    m.def("threads", &exchange::threads, "Threads that the parallel loops use.");
    m.def(
        "set_threads", &exchange::set_threads, py::arg("count"),
        "Sets the number of threads of all later loops; 0: HEMOFLUX_THREADS, else all cores. Results do not "
        "depend on it.");
    python::bind_case(m);
    python::bind_run(m);
    python::bind_simulation(m);
    python::bind_membrane(m);
}
