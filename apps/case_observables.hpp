/// What a case wants measured in its flow: [observables] and [[profile]].
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/toml_input.hpp"

namespace hemoflux::apps {

/// observables.body; lengths in um, directions as given.
struct BodyInput {
    std::string patch;
    std::array<double, 3> direction{1, 0, 0}, lift{0, 1, 0};
    std::optional<std::array<double, 3>> centre, front, rear;
    std::optional<double> area;  ///< um^2
    bool operator==(const BodyInput&) const = default;
};

/// [observables]
struct ObservablesInput {
    std::optional<double> speed;   ///< um/s
    std::optional<double> length;  ///< um
    bool cavity = false;
    std::optional<BodyInput> body;
    bool operator==(const ObservablesInput&) const = default;
};

/// [[profile]]
struct ProfileInput {
    std::size_t component = 0;                     ///< of the velocity
    std::size_t along = 0;                         ///< axis
    std::optional<std::array<double, 3>> through;  ///< um
    std::string file;
    std::string position, value;    ///< columns
    std::vector<std::string> rows;  ///< column and word, or empty
    std::vector<double> skip;
    std::string name, label;
    bool operator==(const ProfileInput&) const = default;
};

ObservablesInput read_observables(const Section& in);
ProfileInput read_profile(const Section& in);

}  // namespace hemoflux::apps
