#include "apps/interrupt.hpp"

#include <csignal>

namespace hemoflux::apps {
namespace {

volatile std::sig_atomic_t arrived = 0;

void note(int signal) {
    arrived = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

bool interrupted() { return arrived != 0; }

}  // namespace hemoflux::apps
