/// Rules between the keys of a case that no single key can state.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace hemoflux::apps {

/// Checks a resolved case: tables the kind needs, both sides of every axis, one length of run, one time step,
/// grid parameters of the chosen spacing, references. `name` is the file in messages. Throws InputError.
void check_rules(const toml::table& resolved, const std::string& name);

/// The part of them about patches, forces, exact solutions and sweeps.
void check_flow_rules(const toml::table& resolved, const std::string& name);

/// The part of them about the length of a run in time and its step.
void check_time_rules(const toml::table& resolved, const std::string& name);

}  // namespace hemoflux::apps
