/// The cells of a run as an animation: the surfaces of all frames, packed for the script of the page.
#pragma once

#include <cstddef>
#include <string>

#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// Most bytes of vertex positions in one page; longer series are thinned evenly.
constexpr std::size_t most_animation_bytes = 6 * 1024 * 1024;

/// The viewer of a run's cells as a figure element: canvas, slider, play button, data. Positions are rounded to 1/65534 of
/// the largest extent of all frames (16-bit integers as base64); triangles are stored once for every topology that
/// occurs. "" for a run without cell files. FileError, InputError when a cell file cannot be read.
std::string animation(const RunRecord& run, std::size_t most_bytes = most_animation_bytes);

}  // namespace hemoflux::report
