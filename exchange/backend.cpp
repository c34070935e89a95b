#include "exchange/backend.hpp"

#include <cstdlib>

#include "exchange/error.hpp"

#if defined(HEMOFLUX_BACKEND_OMP)
#include <omp.h>
#include <unistd.h>
#elif defined(HEMOFLUX_BACKEND_TBB)
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <memory>
#endif

namespace hemoflux::exchange {
namespace {

[[maybe_unused]] int from_environment() {
    const char* text = std::getenv("HEMOFLUX_THREADS");
    const int count = text ? std::atoi(text) : 0;
    return count > 0 ? count : 0;
}

#if defined(HEMOFLUX_BACKEND_OMP)
struct Threads {
    int standard = omp_get_max_threads();
    Threads() { set(0); }
    void set(int count) {
        if (count == 0) count = from_environment();
        omp_set_num_threads(count > 0 ? count : standard);
    }
    int get() const { return omp_get_max_threads(); }
};
#elif defined(HEMOFLUX_BACKEND_TBB)
struct Threads {
    std::unique_ptr<tbb::global_control> control;
    int count_ = 0;
    Threads() { set(0); }
    void set(int count) {
        if (count == 0) count = from_environment();
        if (count == 0) count = tbb::info::default_concurrency();
        control.reset();
        control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                        static_cast<std::size_t>(count));
        count_ = count;
    }
    int get() const { return count_; }
};
#else
struct Threads {
    void set(int) {}
    int get() const { return 1; }
};
#endif

Threads& state() {
    static Threads threads;
    return threads;
}

}  // namespace

std::string backend_name() {
#if defined(HEMOFLUX_BACKEND_OMP)
    return "OMP";
#elif defined(HEMOFLUX_BACKEND_TBB)
    return "TBB";
#elif defined(HEMOFLUX_BACKEND_CUDA)
    return "CUDA";
#else
    return "CPP";
#endif
}

int threads() { return state().get(); }

void set_threads(int count) {
    if (count < 0)
        throw InputError("number of threads " + std::to_string(count), "it cannot be negative",
                         "give a positive number, or 0 for the machine's default");
    state().set(count);
}

void limit_spinning([[maybe_unused]] char** arguments) {
#if defined(HEMOFLUX_BACKEND_OMP)
    constexpr const char* spins = "1000";
    if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
    if (setenv("GOMP_SPINCOUNT", spins, 0) == 0) execv("/proc/self/exe", arguments);
#endif
}

}  // namespace hemoflux::exchange
