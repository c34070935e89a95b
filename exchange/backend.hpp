/// Which parallel backend this build uses, and how many threads it runs on.
#pragma once

#include <string>

namespace hemoflux::exchange {

/// "OMP", "TBB", "CPP" or "CUDA".
std::string backend_name();

/// Threads the parallel loops will use: set_threads(), else HEMOFLUX_THREADS, else the backend's default; 1
/// for CPP and CUDA.
int threads();

/// Sets the number of threads of all later parallel loops; 0 restores the default. Ignored by CPP and CUDA.
/// Throws InputError when count is negative.
void set_threads(int count);

}  // namespace hemoflux::exchange
