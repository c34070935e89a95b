/// What the parts of the Python module share. Arrays that leave it are copies in C order.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::python {

namespace py = pybind11;

/// Each adds its classes and functions to the module.
void bind_case(py::module_& m);
void bind_run(py::module_& m);
void bind_simulation(py::module_& m);
void bind_membrane(py::module_& m);

/// An array of this shape, whose product is values.size().
inline py::array_t<double> to_array(const std::vector<double>& values,
                                    const std::vector<py::ssize_t>& shape) {
    return py::array_t<double>(shape, values.data());
}
inline py::array_t<double> to_array(const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// Vectors as an array of shape (..., 3); shape[...] is (n) where it is left out.
inline py::array_t<double> to_array(const std::vector<Vec3d>& values, std::vector<py::ssize_t> shape = {}) {
    if (shape.empty()) shape = {static_cast<py::ssize_t>(values.size())};
    shape.push_back(3);
    py::array_t<double> array(shape);
    double* p = array.mutable_data();
    for (const Vec3d& v : values) {
        *p++ = v.x;
        *p++ = v.y;
        *p++ = v.z;
    }
    return array;
}

/// Vertex numbers of triangles, shape (n, 3).
inline py::array_t<int> to_array(const std::vector<std::array<int, 3>>& triangles) {
    py::array_t<int> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
    int* p = array.mutable_data();
    for (const auto& t : triangles)
        for (const int v : t) *p++ = v;
    return array;
}

/// A table as a dict from the name of each column to its array.
inline py::dict to_dict(const std::vector<std::string>& columns,
                        const std::vector<std::vector<double>>& rows) {
    py::dict dict;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        std::vector<double> column;
        for (const auto& row : rows) column.push_back(row[c]);
        dict[py::str(columns[c])] = to_array(column);
    }
    return dict;
}

}  // namespace hemoflux::python
