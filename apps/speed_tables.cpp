#include <fmt/format.h>

#include "apps/speed.hpp"

namespace hemoflux::apps {

std::string describe(const Machine& m) {
    return fmt::format("processor  {}\ncores      {}\nthreads    {} ({})\nlanes      {} doubles\n",
                       m.processor, m.cores, m.threads, m.backend, m.lanes);
}

std::string table(const Machine& m, const std::vector<Timing>& timings) {
    std::string text =
        fmt::format("{:<52} {:>10} {:>12} {:>20} {:>14} {:>14} {:>12}\n", "kernel", "cells", "time, ms",
                    "million cells/s/core", "operations", "GFLOP/s/core", "GB/s/core");
    for (const Timing& t : timings) {
        text += fmt::format("{:<52} {:>10} {:>12.3f} {:>20.2f}", t.kernel, t.cells, t.seconds * 1e3,
                            t.rate(m.threads));
        if (t.work.operations > 0)
            text += fmt::format(" {:>14.0f} {:>14.1f} {:>12.1f}", t.work.operations,
                                t.rate(m.threads) * t.work.operations * 1e-3,
                                t.rate(m.threads) * t.work.bytes * 1e-3);
        text += "\n";
    }
    return text +
           "operations: per cell, counted by hand; GB/s: what must pass between processor and memory\n";
}

std::string to_json(const Machine& m, const std::vector<Timing>& timings) {
    std::string text = fmt::format(
        "{{\n  \"processor\": \"{}\",\n  \"backend\": \"{}\",\n  \"cores\": {},\n  \"threads\": {},\n"
        "  \"lanes\": {},\n  \"kernels\": [\n",
        m.processor, m.backend, m.cores, m.threads, m.lanes);
    for (std::size_t i = 0; i < timings.size(); ++i) {
        const Timing& t = timings[i];
        text += fmt::format(
            "    {{\"kernel\": \"{}\", \"cells\": {}, \"seconds\": {}, \"cells_per_s_per_core\": {}, "
            "\"operations_per_cell\": {}, \"bytes_per_cell\": {}}}{}\n",
            t.kernel, t.cells, t.seconds, t.rate(m.threads) * 1e6, t.work.operations, t.work.bytes,
            i + 1 < timings.size() ? "," : "");
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

std::string table_3_18(const Machine& m, const std::vector<SteadyCavity>& cavities) {
    std::string text = fmt::format(
        "Table 3.18: seconds of steady lid-driven square cavities, the thesis's (local time steps, change of "
        "the "
        "velocity below 1e-6) beside ours\n(implicit steps, residual of the momentum below 1e-7 of its first "
        "value; {} threads).\n{:<6} {:>8} {:<10} {:>14} {:>14} {:>14} {:>14}\n",
        m.threads, "Re", "cells", "grid", "Gauss", "ours", "least squares", "ours");
    for (const SteadyCavity& c : cavities) {
        if (c.uniform)
            text += fmt::format("{:<6} {:>8} {:<10} {:>14} {:>14} {:>14.2f} {:>14.2f}\n", c.reynolds, c.cells,
                                "uniform", "", "", c.thesis[1], c.ours[1]);
        else
            text += fmt::format("{:<6} {:>8} {:<10} {:>14.2f} {:>14.2f} {:>14.2f} {:>14.2f}\n", c.reynolds,
                                c.cells, "Chebyshev", c.thesis[0], c.ours[0], c.thesis[1], c.ours[1]);
    }
    return text;
}

}  // namespace hemoflux::apps
