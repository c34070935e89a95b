// The sequence of shapes over spontaneous curvature and relaxed area difference.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "apps/cell_surface.hpp"
#include "apps/membrane_task.hpp"
#include "apps/output/history.hpp"
#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/fields.hpp"
#include "membrane/shape_kind.hpp"

namespace hemoflux::apps {
namespace {

constexpr const char* kind_names[] = {"stomatocyte", "discocyte", "echinocyte", "other"};

/// One relaxed shape.
struct Shape {
    double c0 = 0, m0 = 0;
    std::size_t nodes = 0;
    double energy = NAN, coarse = NAN;  ///< 1e-17 J; coarse: with a quarter of the nodes
    membrane::ShapeSigns signs;
    bool found = false;
};

/// The values of a list, or the cell's own.
std::vector<double> values(const std::vector<double>& list, double own) {
    return list.empty() ? std::vector<double>{own} : list;
}

/// The relaxed cell; nothing, and a warning, where that fails: one shape must not hide the others.
std::optional<membrane::Batch> relaxed(MembraneRun& run, const CellInput& cell, const std::string& name) {
    try {
        return run.rest(cell, name);
    } catch (const NumericalError& error) {
        run.log.warn(fmt::format("{}: {}", name, error.what()));
        return std::nullopt;
    }
}

/// The shape of a cell, on four times the nodes as well where the case asks for it; the finer one is shown.
Shape relax_shape(MembraneRun& run, CellInput cell, const std::string& name,
                  std::vector<output::GalleryItem>& items) {
    Shape shape;
    shape.c0 = *cell.spontaneous_curvature;
    shape.m0 = *cell.relaxed_area_difference;
    std::optional<membrane::Batch> batch = relaxed(run, cell, name);
    if (!batch) return shape;
    if (run.input.membrane.refine) {
        cell.nodes = 4 * cell.nodes - 6;
        if (std::optional<membrane::Batch> fine = relaxed(run, cell, name + ", refined")) {
            shape.coarse = batch->energies(0).total();
            batch = std::move(fine);
        }
    }
    shape.nodes = batch->vertices();
    shape.energy = batch->energies(0).total();
    shape.signs = membrane::shape_signs(batch->topology(), batch->positions(0),
                                        membrane::vertex_fields(*batch, 0).curvature);
    shape.found = true;
    run.describe(*batch, name + ".");
    items.push_back({run.frame(*batch, static_cast<double>(run.series.next())),
                     fmt::format("{}\nc0 = {:g}, M0 = {:g}\n{:.4g} aJ, {} nodes",
                                 kind_names[static_cast<int>(shape.signs.kind)], shape.c0, shape.m0,
                                 shape.energy * attojoule_per_unit, shape.nodes)});
    return shape;
}

std::string row_text(const Shape& s) {
    if (!s.found) return fmt::format("{:>8g} {:>8g}  not converged", s.c0, s.m0);
    std::string text =
        fmt::format("{:>8g} {:>8g} {:>7} {:>12.6g}  {:<12}{:>9} {:>10.3f} {:>8.3f}", s.c0, s.m0, s.nodes,
                    s.energy * attojoule_per_unit, kind_names[static_cast<int>(s.signs.kind)],
                    s.signs.spicules, s.signs.asymmetry, s.signs.dimple);
    if (std::isfinite(s.coarse)) text += fmt::format(" {:>+9.3f} %", 100 * (s.energy / s.coarse - 1));
    return text;
}

}  // namespace

void run_shapes(MembraneRun& run) {
    const MembraneInput& in = run.input.membrane;
    output::Table table{{"cell", "c0", "m0", "nodes", "energy_aJ", "coarse_energy_aJ", "kind", "spicules",
                         "asymmetry", "dimple"},
                        {}};
    std::vector<output::GalleryItem> items;
    std::string text =
        fmt::format("{:>8} {:>8} {:>7} {:>12}  {:<12}{:>9} {:>10} {:>8}{}", "c0", "M0/8piR0", "nodes",
                    "energy, aJ", "kind", "spicules", "asymmetry", "dimple", in.refine ? "  from N/4" : "");
    std::size_t columns = 0, found = 0;
    for (std::size_t i = 0; i < run.input.cells.size(); ++i) {
        const membrane::RestState own = rest_state(run.input.cells[i]);
        const auto curvatures = values(in.curvatures, own.reduced_curvature);
        const auto differences = values(in.area_differences, own.area_difference);
        columns = std::max(columns, curvatures.size());
        for (const double m0 : differences)
            for (const double c0 : curvatures) {
                CellInput cell = run.input.cells[i];
                cell.spontaneous_curvature = c0;
                cell.relaxed_area_difference = m0;
                const std::string name = curvatures.size() * differences.size() == 1
                                             ? run.label(i)
                                             : fmt::format("{}c0_{:g}_m0_{:g}", run.prefix(i), c0, m0);
                const Shape s = relax_shape(run, cell, name, items);
                table.rows.push_back({static_cast<double>(i), c0, m0, static_cast<double>(s.nodes),
                                      s.energy * attojoule_per_unit, s.coarse * attojoule_per_unit,
                                      static_cast<double>(s.signs.kind),
                                      static_cast<double>(s.signs.spicules), s.signs.asymmetry,
                                      s.signs.dimple});
                text.append(1, '\n').append(row_text(s));
                found += s.found;
                run.summary.observables[name + ".kind"] = static_cast<double>(s.signs.kind);
                run.summary.observables[name + ".spicules"] = s.signs.spicules;
                if (in.refine)
                    run.summary.observables[name + ".energy_change_refined"] = s.energy / s.coarse - 1;
            }
    }
    if (found == 0)
        throw NumericalError("no shape is found", "no relaxation has converged",
                             "Look into log.txt; coarser meshes and smaller c0 and M0 converge more easily");
    output::write_table(run.folder.path() / "shapes.csv", table);
    run.log.info(text + "\n(kind in shapes.csv: 0 stomatocyte, 1 discocyte, 2 echinocyte, 3 other)");
    run.gallery({.title = run.input.title,
                 .items = items,
                 .columns = columns > 1 ? static_cast<int>(columns) : 4,
                 .colour = "curvature_per_um",
                 .legend = "curvature c1 + c2, 1/\xC2\xB5m"},
                "picture_shapes");
}

}  // namespace hemoflux::apps
