#include "fluid/state.hpp"

#include <stdexcept>

namespace hemoflux::fluid {

State::State(const exchange::Layout& layout, bool with_force, bool with_viscosity, double nu)
    : layout_(layout) {
    const auto add = [&](double value) {
        fields_.emplace_back(layout.size);
        fields_.back().fill(value);
        return fields_.back().data();
    };
    fields_.reserve(8);
    view_.q[0] = add(1.0);
    for (int c = 1; c < 4; ++c) view_.q[c] = add(0.0);
    if (with_force)
        for (double*& f : view_.force) f = add(0.0);
    if (with_viscosity) view_.nu = add(nu);
}

std::vector<double> State::interior(const double* field) const {
    std::vector<double> padded(layout_.size), values;
    exchange::copy_to_host(padded.data(), field, layout_.size * sizeof(double));
    values.reserve(layout_.cells());
    for (std::size_t k = 0; k < layout_.n[2]; ++k)
        for (std::size_t j = 0; j < layout_.n[1]; ++j) {
            const double* row = padded.data() + layout_.origin + j * layout_.row + k * layout_.plane;
            values.insert(values.end(), row, row + layout_.n[0]);
        }
    return values;
}

void State::set_interior(double* field, const std::vector<double>& values) {
    if (values.size() != layout_.cells())
        throw std::length_error("State::set_interior: wrong number of cells");
    std::vector<double> padded(layout_.size);
    exchange::copy_to_host(padded.data(), field, layout_.size * sizeof(double));
    auto value = values.begin();
    for (std::size_t k = 0; k < layout_.n[2]; ++k)
        for (std::size_t j = 0; j < layout_.n[1]; ++j)
            for (std::size_t i = 0; i < layout_.n[0]; ++i)
                padded[layout_.origin + i + j * layout_.row + k * layout_.plane] = *value++;
    exchange::copy_to_device(field, padded.data(), layout_.size * sizeof(double));
}

}  // namespace hemoflux::fluid
