#include "apps/report/description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/toml_input.hpp"

namespace hemoflux::report {
namespace {

/// The values of an array joined, "30 x 30 x 30" with multiplication signs.
std::string product(const RunRecord& run, const std::string& path) {
    std::vector<std::string> parts;
    if (const auto* array = run.input.at_path(path).as_array())
        for (const auto& value : *array) {
            const auto words = value.value<std::string>();
            parts.push_back(words ? *words : apps::value_text(value));
        }
    return fmt::format("{}", fmt::join(parts, " \xC3\x97 "));
}

std::size_t length_of(const RunRecord& run, const std::string& path) {
    const auto* array = run.input.at_path(path).as_array();
    return array ? array->size() : 0;
}

std::string grid(const RunRecord& run) {
    if (const std::string file = run.text("grid.mesh.file"); !file.empty())
        return "the mesh " + std::filesystem::path(file).filename().string();
    if (const std::string shape = run.text("grid.mesh.kind"); !shape.empty())
        return fmt::format("an unstructured mesh {} a {}", shape == "cylinder" ? "around" : "of",
                           shape == "constriction" ? "narrowed pipe" : shape);
    const std::string cells = product(run, "grid.cells"), kind = run.text("grid.kind");
    return fmt::format("a {} grid of {} cells over {}", kind.empty() ? "rectilinear" : kind, cells,
                       product(run, "grid.length"));
}

std::string fluid(const RunRecord& run) {
    return fmt::format("The fluid has a density of {} and a viscosity of {}", run.text("fluid.density"),
                       run.text("fluid.viscosity"));
}

std::string duration(const RunRecord& run) {
    if (const std::string strain = run.text("time.strain"); !strain.empty())
        return " to a strain of " + strain;
    if (const std::string time = run.text("time.duration"); !time.empty()) return " for " + time;
    return "";
}

/// The first template of cells, and how many there are of others.
std::string cells(const RunRecord& run) {
    const std::size_t templates = length_of(run, "cell");
    if (templates == 0) return "";
    const auto of = [&](const char* key) { return run.text(std::string("cell[0].") + key); };
    std::string what = of("shape");
    if (const std::string file = of("file"); !file.empty())
        what = "shape from " + std::filesystem::path(file).filename().string();
    std::string text = fmt::format("a {}", what.empty() ? "cell" : what);
    if (!of("nodes").empty()) text += " of " + of("nodes") + " nodes";
    if (!of("shear_modulus").empty()) text += ", shear modulus " + of("shear_modulus");
    if (!of("reference").empty()) text += ", reference state \xE2\x80\x9C" + of("reference") + "\xE2\x80\x9D";
    if (templates > 1) text += fmt::format(", and {} further cells", templates - 1);
    return text;
}

std::string coupled(const RunRecord& run) {
    std::string text = "A coupled run: " + cells(run);
    if (const std::string rate = run.text("shear.rate"); !rate.empty()) text += ", in shear of " + rate;
    text += ". " + fluid(run);
    if (const std::string inside = run.text("cell[0].cytosol_viscosity"); !inside.empty())
        text += ", the inside of the cell " + inside;
    return text +
           fmt::format(
               ". The lattice Boltzmann flux solver runs on {}{}; the immersed boundary method couples it "
               "to the membrane, a network of springs with bending and area-difference energies.",
               grid(run), duration(run));
}

std::string flow(const RunRecord& run) {
    const bool steady = run.kind == "steady";
    std::string text = fmt::format("A {} computed by the lattice Boltzmann flux solver on {}{}. {}.",
                                   steady ? "steady flow" : "flow in time", grid(run),
                                   steady ? "" : duration(run), fluid(run));
    if (const std::string exact = run.text("analytical.solution"); !exact.empty())
        text += " It is compared with the exact solution \xE2\x80\x9C" + exact + "\xE2\x80\x9D.";
    return text;
}

std::string membrane(const RunRecord& run) {
    const std::string task = run.text("membrane.task");
    const std::string what = task == "stretch"
                                 ? "pulled apart along x, as by optical tweezers, and relaxed at every force"
                             : task == "shapes" ? "relaxed at every spontaneous curvature and area difference"
                             : task == "moduli" ? "measured as a flat sheet under every in-plane law"
                             : task == "relax-back" ? "stretched and let go"
                             : task == "calibrate"  ? "fitted to measured stretch curves"
                                                    : "relaxed to its minimum of energy";
    return fmt::format("A membrane alone, without a fluid: {}, {}.", cells(run), what);
}

/// The text with units as they are printed: um as \xC2\xB5m, ^2 and ^3 raised.
std::string typeset(std::string text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    for (std::size_t i = 0; i + 1 < text.size(); ++i)
        if (text[i] == 'u' && (i == 0 || text[i - 1] == ' ') && (text[i + 1] == 'm' || text[i + 1] == 'N') &&
            (i + 2 == text.size() || !is_letter(text[i + 2])))
            text.replace(i, 1, "\xC2\xB5");
    for (const auto& [plain, raised] : {std::pair{"^2", "\xC2\xB2"}, {"^3", "\xC2\xB3"}})
        for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain))
            text.replace(at, 2, raised);
    return text;
}

}  // namespace

std::string kind_in_words(const RunRecord& run) {
    return run.kind == "coupled"    ? "Coupled run"
           : run.kind == "fluid"    ? "Flow"
           : run.kind == "steady"   ? "Steady flow"
           : run.kind == "membrane" ? "Membrane"
           : run.kind == "sweep"    ? "Sweep"
                                    : "Run";
}

std::string description(const RunRecord& run) {
    if (run.is_sweep()) {
        std::string keys;
        for (std::size_t k = 0; run.sweep && k < run.sweep->keys; ++k)
            keys += (k == 0 ? "" : ", ") + run.sweep->columns[k];
        RunRecord base;
        base.input = run.input;
        base.kind = run.text("kind") == "fluid" && run.input.contains("steady") ? "steady" : run.text("kind");
        std::string of_base = description(base);
        of_base.front() = 'a';  // each begins with the word "A"
        return (run.sweep
                    ? fmt::format("A sweep of {} runs over {}. Its case: ", run.sweep->rows.size(), keys)
                    : std::string("A sweep. Its case: ")) +
               of_base;
    }
    return typeset(run.kind == "coupled" ? coupled(run) : run.kind == "membrane" ? membrane(run) : flow(run));
}

}  // namespace hemoflux::report
