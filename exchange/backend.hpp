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

/// For a program's first line. Waiting threads of GCC's OpenMP runtime spin, which on a machine that does other work too
/// makes two threads ten times slower than one. Unless OMP_WAIT_POLICY or GOMP_SPINCOUNT is set, this sets a short
/// GOMP_SPINCOUNT and starts the program anew with the same arguments, because the runtime reads it only at its start.
/// Returns when there is nothing to do (other backends, already set) or the system refuses.
void limit_spinning(char** arguments);

}  // namespace hemoflux::exchange
