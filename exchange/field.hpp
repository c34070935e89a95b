/// Named, typed fields: what one solver offers and another reads, with its shape and unit.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace hemoflux::exchange {

/// Whether a field has one value per place or three.
enum class Shape { scalar = 1, vector = 3 };

/// A trivially copyable window on a field in device memory: value i of component c is component[c][stride * i].
struct FieldView {
    double* component[3] = {nullptr, nullptr, nullptr};
    /// Values per component, ghost and padding values included.
    std::size_t size = 0;
    /// 1 where every component is an array of its own, the length of a record where components lie side by side.
    std::size_t stride = 1;
};

/// What a field is: name ("velocity"), shape and unit in the solver's non-dimensional system ("c", "1e-11
/// N").
struct FieldInfo {
    std::string name;
    Shape shape = Shape::scalar;
    std::string unit;
};

/// The table on which solvers lay their fields. A reader must ask for the shape and the unit it expects.
class FieldTable {
  public:
    /// Lays a field on the table under owner.name, e.g. "fluid.velocity". Throws std::logic_error if it is
    /// there already.
    void offer(const std::string& owner, const FieldInfo& info, const FieldView& view);

    /// The view of "owner.name". Throws std::logic_error that names both sides when it is missing, or when
    /// shape or unit differ from what the reader expects.
    [[nodiscard]] FieldView read(const std::string& full_name, Shape shape, const std::string& unit) const;

    /// All fields on the table, ordered by name; for the start-up summary.
    [[nodiscard]] std::vector<FieldInfo> list() const;

  private:
    struct Entry {
        FieldInfo info;
        FieldView view;
    };
    std::map<std::string, Entry> entries_;
};

}  // namespace hemoflux::exchange
