#include "exchange/field.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace hemoflux::exchange {
namespace {
const char* name_of(Shape shape) { return shape == Shape::scalar ? "scalar" : "vector"; }
}  // namespace

void FieldTable::offer(const std::string& owner, const FieldInfo& info, const FieldView& view) {
    FieldInfo full = info;
    full.name = owner + "." + info.name;
    if (!entries_.emplace(full.name, Entry{full, view}).second)
        throw std::logic_error(fmt::format("field {} is offered twice", full.name));
}

FieldView FieldTable::read(const std::string& full_name, Shape shape, const std::string& unit) const {
    const auto found = entries_.find(full_name);
    if (found == entries_.end()) throw std::logic_error(fmt::format("field {} is not offered", full_name));
    const FieldInfo& info = found->second.info;
    if (info.shape != shape || info.unit != unit)
        throw std::logic_error(fmt::format("field {} is a {} in {}, but is read as a {} in {}", full_name,
                                           name_of(info.shape), info.unit, name_of(shape), unit));
    return found->second.view;
}

std::vector<FieldInfo> FieldTable::list() const {
    std::vector<FieldInfo> infos;
    for (const auto& [name, entry] : entries_) infos.push_back(entry.info);
    return infos;
}

}  // namespace hemoflux::exchange
