#include "apps/output/summary.hpp"

#include <json/json.h>

#include <memory>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

Json::Value number(double value) { return std::isfinite(value) ? Json::Value(value) : Json::Value(); }
Json::Value number(const std::optional<double>& value) { return value ? number(*value) : Json::Value(); }

double to_double(const Json::Value& value) { return value.isNull() ? NAN : value.asDouble(); }
std::optional<double> to_optional(const Json::Value& value) {
    return value.isNull() ? std::nullopt : std::optional<double>(value.asDouble());
}

// integral counts are written without ".0"
Json::Value count(double value) {
    return std::isfinite(value) ? Json::Value(static_cast<Json::Int64>(std::llround(value))) : Json::Value();
}

Json::Value object(const std::map<std::string, double>& values) {
    Json::Value out(Json::objectValue);
    for (const auto& [name, value] : values) out[name] = number(value);
    return out;
}

std::map<std::string, double> to_map(const Json::Value& values) {
    std::map<std::string, double> out;
    for (const std::string& name : values.getMemberNames()) out[name] = to_double(values[name]);
    return out;
}

double observed(const Summary& summary, const std::string& name) {
    const auto it = summary.observables.find(name);
    return it == summary.observables.end() ? NAN : it->second;
}

Summary from_json(const Json::Value& root) {
    Summary s;
    s.case_name = root["case"].asString();
    s.version = root["version"].asString();
    s.backend = root["backend"].asString();
    s.threads = root["threads"].asInt();
    s.observables = to_map(root["observables"]);
    for (const std::string& name : root["labels"].getMemberNames())
        s.labels[name] = root["labels"][name].asString();
    for (const std::string& name : root["references"].getMemberNames()) {
        const Json::Value& r = root["references"][name];
        s.references[name] = {to_optional(r["reference"]), to_optional(r["low"]), to_optional(r["high"]),
                              r["source"].asString()};
    }
    const Json::Value& c = root["conservation"];
    s.conservation = {to_double(c["volume"]), to_double(c["area"]), to_double(c["mean_density_per_strain"]),
                      to_double(c["centroid_um"])};
    const Json::Value& p = root["performance"];
    s.performance = {to_double(p["wall_s"]),
                     to_double(p["cpu_s"]),
                     to_double(p["steps"]),
                     to_double(p["residuals_per_strain"]),
                     to_double(p["cell_residuals_per_s"]),
                     to_double(p["peak_rss_mib"])};
    s.errors_estimated = to_map(root["errors_estimated"]);
    return s;
}

}  // namespace

std::string to_json(const Summary& s) {
    Json::Value root(Json::objectValue);
    root["case"] = s.case_name;
    root["version"] = s.version;
    root["backend"] = s.backend;
    root["threads"] = s.threads;
    root["observables"] = object(s.observables);
    Json::Value& labels = root["labels"] = Json::Value(Json::objectValue);
    for (const auto& [name, text] : s.labels) labels[name] = text;
    Json::Value& references = root["references"] = Json::Value(Json::objectValue);
    for (const auto& [name, r] : s.references) {
        Json::Value& out = references[name];
        out["value"] = number(observed(s, name));
        out["reference"] = number(r.reference);
        out["low"] = number(r.low);
        out["high"] = number(r.high);
        out["source"] = r.source;
    }
    Json::Value& c = root["conservation"];
    c["volume"] = number(s.conservation.volume);
    c["area"] = number(s.conservation.area);
    c["mean_density_per_strain"] = number(s.conservation.mean_density_per_strain);
    c["centroid_um"] = number(s.conservation.centroid_um);
    Json::Value& p = root["performance"];
    p["wall_s"] = number(s.performance.wall_s);
    p["cpu_s"] = number(s.performance.cpu_s);
    p["steps"] = count(s.performance.steps);
    p["residuals_per_strain"] = number(s.performance.residuals_per_strain);
    p["cell_residuals_per_s"] = number(s.performance.cell_residuals_per_s);
    p["peak_rss_mib"] = number(s.performance.peak_rss_mib);
    root["errors_estimated"] = object(s.errors_estimated);

    Json::StreamWriterBuilder builder;
    builder["indentation"] = "  ";
    builder["precision"] = 17;  // every double reads back as itself
    builder["emitUTF8"] = true;
    return Json::writeString(builder, root) + "\n";
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
    write_file(path, to_json(summary));
}

Summary read_summary(const std::filesystem::path& path) {
    std::istringstream text(read_file(path));
    Json::Value root;
    std::string errors;
    try {
        if (Json::parseFromStream(Json::CharReaderBuilder(), text, &root, &errors)) return from_json(root);
    } catch (const Json::Exception& error) {
        errors = error.what();
    }
    if (!errors.empty() && errors.back() == '\n') errors.pop_back();
    throw InputError("malformed summary " + path.string(), errors,
                     "Give a summary.json that a run has written");
}

std::vector<Comparison> compare(const Summary& summary) {
    std::vector<Comparison> out;
    for (const auto& [name, r] : summary.references) {
        const double value = observed(summary, name);
        std::optional<double> relative;
        if (r.reference && *r.reference != 0) relative = value / *r.reference - 1;
        // written so that NaN is outside
        const bool inside = value >= r.low.value_or(-INFINITY) && value <= r.high.value_or(INFINITY);
        const auto verdict = r.low || r.high
                                 ? (inside ? Comparison::Verdict::inside : Comparison::Verdict::outside)
                             : std::isfinite(value) ? Comparison::Verdict::reported
                                                    : Comparison::Verdict::outside;
        out.push_back({name, value, r, relative, verdict});
    }
    return out;
}

}  // namespace hemoflux::output
