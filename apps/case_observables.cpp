#include "apps/case_observables.hpp"

namespace hemoflux::apps {
namespace {

std::optional<std::array<double, 3>> maybe_vector(const Section& in, const std::string& key) {
    if (in.numbers(key).empty()) return std::nullopt;
    return in.vector(key);
}

}  // namespace

ObservablesInput read_observables(const Section& in) {
    ObservablesInput o{in.maybe("speed"), in.maybe("length"), in.flag("cavity"), {}};
    if (const auto body = in.table("body"))
        o.body = {body->text("patch"),          body->vector("direction"),
                  body->vector("lift"),         maybe_vector(*body, "centre"),
                  maybe_vector(*body, "front"), maybe_vector(*body, "rear"),
                  body->maybe("area")};
    return o;
}

ProfileInput read_profile(const Section& in) {
    const auto columns = in.texts("columns");
    return {static_cast<std::size_t>(in.text("field")[0] - 'u'),
            static_cast<std::size_t>(in.text("along")[0] - 'x'),
            maybe_vector(in, "through"),
            in.text("file"),
            columns[0],
            columns[1],
            in.texts("rows"),
            in.numbers("skip"),
            in.text("name"),
            in.text("label")};
}

}  // namespace hemoflux::apps
