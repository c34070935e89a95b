#include <fmt/format.h>

#include "apps/speed.hpp"

namespace hemoflux::apps {

std::string describe(const Machine& m) {
    return fmt::format("processor  {}\ncores      {}\nthreads    {} ({})\nlanes      {} doubles\n",
                       m.processor, m.cores, m.threads, m.backend, m.lanes);
}

std::string table(const Machine& m, const std::vector<Timing>& timings) {
    std::string text =
        fmt::format("{:<52} {:>10} {:>12} {:>20}\n", "kernel", "cells", "time, ms", "million cells/s/core");
    for (const Timing& t : timings)
        text += fmt::format("{:<52} {:>10} {:>12.3f} {:>20.2f}\n", t.kernel, t.cells, t.seconds * 1e3,
                            t.rate(m.threads));
    return text;
}

std::string to_json(const Machine& m, const std::vector<Timing>& timings) {
    std::string text = fmt::format(
        "{{\n  \"processor\": \"{}\",\n  \"backend\": \"{}\",\n  \"cores\": {},\n  \"threads\": {},\n"
        "  \"lanes\": {},\n  \"kernels\": [\n",
        m.processor, m.backend, m.cores, m.threads, m.lanes);
    for (std::size_t i = 0; i < timings.size(); ++i) {
        const Timing& t = timings[i];
        text += fmt::format(
            "    {{\"kernel\": \"{}\", \"cells\": {}, \"seconds\": {}, \"cells_per_s_per_core\": {}}}{}\n",
            t.kernel, t.cells, t.seconds, t.rate(m.threads) * 1e6, i + 1 < timings.size() ? "," : "");
    }
    return text + "  ]\n}\n";
}

std::string table_8_4(const Machine& m, const CavityCost& structured, const CavityCost& unstructured) {
    std::string text = fmt::format(
        "Table 8.4: seconds of 25,000 iterations of a lid-driven cavity of 1,000,000 cells; the first three "
        "columns are the thesis's.\nOurs: one iteration is a four-stage Runge-Kutta step; {} threads.\n",
        m.threads);
    text += fmt::format("{:<14} {:>12} {:>10} {:>10} {:>12}\n", "mesh", "AMD FX-6300", "Tesla K40", "V100",
                        "this machine");
    const auto row = [&](const char* mesh, int cpu, int k40, int v100, const CavityCost& ours) {
        text += fmt::format(
            "{:<14} {:>12} {:>10} {:>10} {:>12.0f}   from {} iterations of {} cells, {:.1f} "
            "times faster than the FX-6300\n",
            mesh, cpu, k40, v100, ours.table_seconds(), ours.iterations, ours.measured_cells,
            cpu / ours.table_seconds());
    };
    row("structured", 15550, 317, 129, structured);
    row("unstructured", 18401, 930, 392, unstructured);
    return text;
}

}  // namespace hemoflux::apps
