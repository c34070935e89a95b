// Whole runs from Python, into an output folder as the program makes them.
#include "apps/run.hpp"

#include <chrono>
#include <exception>

#include "apps/output/history.hpp"
#include "apps/python/bindings.hpp"
#include "exchange/error.hpp"

namespace hemoflux::python {
namespace {

using apps::Case;
using Clock = std::chrono::steady_clock;

/// Looks at Python now and then while a run goes on without its lock: signals, and the caller's function.
class Watcher {
  public:
    explicit Watcher(py::object progress) : progress_(std::move(progress)) {}

    /// Whether to go on. What Python raises is kept for rethrow().
    bool operator()(const apps::RunPoint& point) {
        const auto now = Clock::now();
        if (now < next_ && point.position < point.end) return true;
        next_ = now + std::chrono::milliseconds(100);
        const py::gil_scoped_acquire lock;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (progress_.is_none()) return true;
            const py::object answer = progress_(point.step, point.position, point.end);
            return answer.is_none() || answer.cast<bool>();
        } catch (...) {
            raised_ = std::current_exception();
            return false;
        }
    }
    void rethrow() const {
        if (raised_) std::rethrow_exception(raised_);
    }

  private:
    py::object progress_;
    Clock::time_point next_ = Clock::now();
    std::exception_ptr raised_;
};

int run(Case c, const std::filesystem::path& output, const std::filesystem::path& restart, int threads,
        bool quiet, py::object progress) {
    c.output.pictures = false;  // the child process that draws them is the program itself
    Watcher watcher(std::move(progress));
    apps::RunOptions options;
    options.output = output;
    options.restart = restart;
    options.threads = threads;
    options.quiet = quiet;
    options.watch = [&watcher](const apps::RunPoint& point) { return watcher(point); };
    int code = 0;
    {
        const py::gil_scoped_release release;
        code =
            c.kind == apps::CaseKind::membrane ? apps::run_membrane(c, options) : apps::run_case(c, options);
    }
    watcher.rethrow();
    return code;
}

}  // namespace

void bind_run(py::module_& m) {
    m.def("_run", &run, py::arg("case"), py::arg("output"), py::arg("restart"), py::arg("threads"),
          py::arg("quiet"), py::arg("progress"));
    m.attr("_interrupted") = static_cast<int>(Exit::interrupted);
    m.def(
        "read_history",
        [](const std::filesystem::path& file) {
            const output::Table table = output::read_table(file);
            return to_dict(table.columns, table.rows);
        },
        py::arg("file"),
        "A CSV file of numbers, as runs write them, as a dict from the name of each column to its array.");
}

}  // namespace hemoflux::python
