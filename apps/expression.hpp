/// Formulas in case files, evaluated by muParser (a small kept library with an exact grammar and clear errors).
#pragma once

#include <functional>
#include <string>

#include "exchange/vec3.hpp"

namespace hemoflux::apps {

/// The function of place (m) and time (s) that `text` writes down, with variables x, y, z, t, the constants _pi and _e
/// and muParser's functions. `where` names the key in messages. The function is not to be called by several threads at
/// once. Throws InputError when the text is no formula.
std::function<double(const Vec3d&, double)> expression(const std::string& text, const std::string& where);

}  // namespace hemoflux::apps
