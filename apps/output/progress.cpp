#include "apps/output/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace hemoflux::output {

std::string duration(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0) return "--";
    const auto s = std::llround(seconds);
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

Progress::Progress(double begin, double end, std::string unit, bool quiet)
    : begin_(begin),
      end_(end),
      unit_(std::move(unit)),
      shown_(!quiet && ::isatty(STDERR_FILENO)),
      start_(Clock::now()),
      next_(start_) {}

std::string Progress::line(const ProgressState& state, double seconds) const {
    const double done = (state.position - begin_) / (end_ - begin_);
    const double left = done > 0 ? seconds * (1 - done) / done : NAN;
    constexpr int width = 20;
    const int filled = std::isfinite(done) ? std::clamp(static_cast<int>(width * done), 0, width) : 0;
    const double rate = seconds > 0 ? state.cell_residuals / seconds : 0;
    return fmt::format("[{:=<{}}{: <{}}] {} {:.3g} of {:.3g}  step {}  {} left  {} cell residuals/s", "",
                       filled, "", width - filled, unit_, state.position, end_, state.step, duration(left),
                       rate > 0 ? fmt::format("{:.2f} M", 1e-6 * rate) : "--");
}

void Progress::update(const ProgressState& state) {
    if (!shown_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    drawn_ = true;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    std::fputs(fmt::format("\r{}\033[K", line(state, seconds)).c_str(), stderr);
    std::fflush(stderr);
}

void Progress::finish() {
    if (!drawn_) return;
    drawn_ = false;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
}

}  // namespace hemoflux::output
