#include "coupling/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

constexpr double safety = 0.9, most_shrink = 0.5, most_growth = 2, worth_growing = 1.25;

struct NoteChange {
    const double* u[3];
    double* last[3];
    double* change;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        double sum = 0;
        for (int q = 0; q < 3; ++q) {
            const double d = u[q][i] - last[q][i];
            sum += d * d;
            last[q][i] = u[q][i];
        }
        change[i] = std::sqrt(sum);
    }
};

struct ChangeOf {
    const double* change;
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t i) const { return {change[i]}; }
};

}  // namespace

StepControl::StepControl(const StepBounds& b) : bounds_(b), step_(b.first) {
    if (!(b.shortest > 0 && b.shortest <= b.first && b.first <= b.longest && b.tolerance > 0))
        throw std::invalid_argument("StepControl: bounds that leave no step");
}

void StepControl::observe(double taken, double error) {
    if (waiting_ > 0) {
        --waiting_;
        return;
    }
    if (std::isnan(error)) return;
    const double before = step_;
    const double allowed =
        error > 0 ? safety * taken * bounds_.tolerance / error : std::numeric_limits<double>::infinity();
    if (error > bounds_.tolerance)
        step_ = std::min(step_, std::max(allowed, most_shrink * step_));
    else if (allowed >= worth_growing * step_)
        step_ = std::min({allowed, most_growth * step_, bounds_.longest});
    if (step_ != before) waiting_ = settling_steps;
}

struct VelocityChange::Scratch {
    exchange::Reduction<exchange::Maximum> largest;
};

VelocityChange::VelocityChange(std::size_t nodes) : change_(nodes), scratch_(new Scratch) {
    for (auto& component : last_) component = exchange::Buffer<double>(nodes);
}

VelocityChange::~VelocityChange() = default;

void VelocityChange::observe(const exchange::FieldView& u) {
    const std::size_t n = change_.size();
    exchange::for_each_index(n,
                             NoteChange{{u.component[0], u.component[1], u.component[2]},
                                        {last_[0].data(), last_[1].data(), last_[2].data()},
                                        change_.data()},
                             exchange::Cost::cheap);
    known_ = seen_;
    seen_ = true;
    if (known_) largest_ = scratch_->largest.sum(n, ChangeOf{change_.data()}).value;
}

std::size_t VelocityChange::where() const {
    const std::vector<double> change = change_.to_host();
    const auto at = std::find(change.begin(), change.end(), largest_);
    return at == change.end() ? 0 : static_cast<std::size_t>(at - change.begin());
}

std::vector<double> VelocityChange::memory() const {
    std::vector<double> all;
    if (!seen_) return all;
    for (const auto& component : last_) {
        const std::vector<double> one = component.to_host();
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

void VelocityChange::restore(const std::vector<double>& memory) {
    const auto n = static_cast<std::ptrdiff_t>(change_.size());
    seen_ = !memory.empty();
    known_ = false;
    if (!seen_) return;
    if (memory.size() != 3 * change_.size())
        throw std::length_error("VelocityChange::restore: wrong number of values");
    for (std::ptrdiff_t q = 0; q < 3; ++q)
        last_[static_cast<std::size_t>(q)].assign({memory.begin() + q * n, memory.begin() + (q + 1) * n});
}

}  // namespace hemoflux::coupling
