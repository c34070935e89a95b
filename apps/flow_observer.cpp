#include "apps/flow_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/body_observer.hpp"
#include "apps/output/history.hpp"
#include "apps/output/reference_table.hpp"
#include "exchange/error.hpp"
#include "fluid/profile.hpp"
#include "fluid/solver.hpp"
#include "fluid/vortices.hpp"

namespace hemoflux::apps {
namespace {

constexpr const char* components = "uvw";
constexpr const char* axes = "xyz";
constexpr int samples = 401;

double reference_speed(const Case& c) {
    const double speed = c.observables->speed.value_or(fastest_side(c));
    if (!(speed > 0))
        throw InputError("the flow has no reference speed",
                         "no side moves, and observables are in units of a speed", "Give observables.speed");
    return speed;
}

/// Summary key of a profile's distance.
std::string key_of(const ProfileInput& in) {
    return fmt::format("{}_profile_rms{}{}", components[in.component], in.name.empty() ? "" : "_", in.name);
}

}  // namespace

FlowObserver::FlowObserver(const Case& c, const Scales& scales, const FlowBox& box, double gamma,
                           const fluid::Flow& flow)
    : case_(c), scales_(scales), box_(box), gamma_(gamma), flow_(flow), speed_(reference_speed(c)) {
    const auto& o = *c.observables;
    if (o.body) check_body(*o.body, flow);
    if (o.body && !o.length)
        throw InputError("observables.length is missing",
                         "forces and the wake of a body are in units of a length",
                         "Give the body's diameter");
    length_ = o.length.value_or(box.upper.x - box.lower.x);
    std::set<std::string> keys;
    for (const ProfileInput& in : c.profiles) {
        if (!keys.insert(key_of(in)).second)
            throw InputError(
                fmt::format("two profiles of {} have the name \"{}\"", components[in.component], in.name),
                "the summary has room for one", "Give each [[profile]] its own name");
        const auto all = output::read_reference_table(in.file);
        const auto table = in.rows.empty() ? all : all.where(in.rows[0], in.rows[1]);
        const auto position = table.numbers(in.position), value = table.numbers(in.value);
        Line line{&in, {}, {}};
        for (std::size_t i = 0; i < position.size(); ++i) {
            const bool skipped = std::any_of(in.skip.begin(), in.skip.end(),
                                             [&](double s) { return std::abs(s - position[i]) < 1e-9; });
            if (skipped || !std::isfinite(position[i]) || !std::isfinite(value[i])) continue;
            line.position.push_back(position[i]);
            line.value.push_back(value[i]);
        }
        if (line.position.empty())
            throw InputError(fmt::format("{} has no values in {}", in.file, in.value),
                             "there is nothing to compare with", "Choose another column");
        lines_.push_back(std::move(line));
    }
}

std::array<Vec3d, 2> FlowObserver::ends(const ProfileInput& in) const {
    Vec3d from = 0.5 * (box_.lower + box_.upper);
    if (in.through) from = {(*in.through)[0], (*in.through)[1], (*in.through)[2]};
    Vec3d to = from;
    component(from, in.along) = component(box_.lower, in.along);
    component(to, in.along) = component(box_.upper, in.along);
    return {from, to};
}

std::string FlowObserver::observe(output::Summary& summary, const output::OutputFolder& folder) const {
    const auto probe = fluid::make_probe(flow_);
    compare_profiles(*probe, summary);
    if (case_.observables->cavity) observe_cavity(*probe, summary, folder);
    if (const auto& body = case_.observables->body)
        observe_body_flow({*body, scales_, gamma_, speed_ / scales_.velocity_um_per_s, length_, box_.upper},
                          flow_, *probe, summary, folder);
    return case_.output.pictures ? plot_profiles(*probe, folder) : "";
}

void FlowObserver::compare_profiles(const fluid::Probe& probe, output::Summary& summary) const {
    const double unit = scales_.velocity_um_per_s / speed_;
    for (const Line& line : lines_) {
        const auto [from, to] = ends(*line.input);
        double sum = 0;
        for (std::size_t i = 0; i < line.position.size(); ++i) {
            Vec3d at = from;
            component(at, line.input->along) += line.position[i] * length_;
            const double e = unit * probe(at)[1 + line.input->component] - line.value[i];
            sum += e * e;
        }
        summary.observables[key_of(*line.input)] = std::sqrt(sum / static_cast<double>(line.position.size()));
    }
}

void FlowObserver::observe_cavity(const fluid::Probe& probe, output::Summary& summary,
                                  const output::OutputFolder& folder) const {
    const Vec3d middle = 0.5 * (box_.lower + box_.upper);
    const double unit = scales_.velocity_um_per_s / speed_;
    const auto u = [&](double y) {
        return unit * probe({middle.x, box_.lower.y + y * length_, middle.z})[1];
    };
    const auto v = [&](double x) {
        return unit * probe({box_.lower.x + x * length_, middle.y, middle.z})[2];
    };
    const double width = (box_.upper.x - box_.lower.x) / length_,
                 height = (box_.upper.y - box_.lower.y) / length_;
    auto& o = summary.observables;
    const auto put = [&o](const std::string& name, const char* axis, const fluid::Extremum& e, double sign) {
        o[name] = sign * e.value;
        o[name + axis] = e.at;
    };
    put("u_min", "_y", fluid::minimum(u, 0, height), 1);
    put("v_min", "_x", fluid::minimum(v, 0, width), 1);
    put("v_max", "_x", fluid::minimum([&](double x) { return -v(x); }, 0, width), -1);
    output::Table vertical{{"y", "u"}, {}}, horizontal{{"x", "v"}, {}};
    for (int i = 0; i < samples; ++i) {
        const double s = static_cast<double>(i) / (samples - 1);
        vertical.rows.push_back({s * height, u(s * height)});
        horizontal.rows.push_back({s * width, v(s * width)});
    }
    output::write_table(folder.path() / "centreline_u.csv", vertical);
    output::write_table(folder.path() / "centreline_v.csv", horizontal);

    const auto* plane = dynamic_cast<const fluid::Solver*>(&flow_);
    if (!plane || plane->grid().rectilinear().axes[2].cells() > 1) return;
    const auto vortices = fluid::find_vortices(fluid::streamfunction(*plane));
    const auto report = [&](const char* name, const auto& belongs) {
        const auto found = std::find_if(vortices.begin(), vortices.end(), belongs);
        if (found == vortices.end()) return;
        const std::string prefix = name;
        o[prefix + "_x"] = (found->x - box_.lower.x) / length_;
        o[prefix + "_y"] = (found->y - box_.lower.y) / length_;
        const double psi = found->psi * unit / length_;
        o[prefix == "vortex" ? "psi_min" : prefix + "_psi"] = psi;
    };
    using fluid::Vortex;
    report("vortex", [](const Vortex& w) { return w.psi < 0; });
    report("vortex_bottom_left",
           [&](const Vortex& w) { return w.psi > 0 && w.x < middle.x && w.y < middle.y; });
    report("vortex_bottom_right",
           [&](const Vortex& w) { return w.psi > 0 && w.x > middle.x && w.y < middle.y; });
    report("vortex_top_left", [&](const Vortex& w) { return w.psi > 0 && w.x < middle.x && w.y > middle.y; });
}

std::string FlowObserver::plot_profiles(const fluid::Probe& probe, const output::OutputFolder& folder) const {
    std::string message;
    std::set<std::string> done;
    for (const Line& line : lines_) {
        const ProfileInput& in = *line.input;
        const std::string stem = fmt::format("plot_profile_{}_{}", components[in.component], axes[in.along]);
        if (!done.insert(stem).second) continue;
        output::PlotSpec spec;
        spec.title = case_.title;
        spec.x_label = fmt::format("{} / L", axes[in.along]);
        spec.y_label = fmt::format("{} / U", components[in.component]);
        output::Curve& computed = spec.curves.emplace_back();
        computed.label = "this run";
        const auto [from, to] = ends(in);
        const fluid::Profile profile = fluid::sample(probe, from, to, samples);
        for (std::size_t i = 0; i < profile.at.size(); ++i) {
            computed.x.push_back(component(profile.at[i] - from, in.along) / length_);
            computed.y.push_back(profile.values[i][1 + in.component] * scales_.velocity_um_per_s / speed_);
        }
        for (const Line& other : lines_) {
            if (other.input->component != in.component || other.input->along != in.along) continue;
            output::Curve& points = spec.curves.emplace_back();
            points.label = other.input->label;
            points.points = true;
            points.x = other.position;
            points.y = other.value;
        }
        if (const auto failed = output::plot(spec, folder.path() / stem)) message = *failed;
    }
    return message;
}

}  // namespace hemoflux::apps
