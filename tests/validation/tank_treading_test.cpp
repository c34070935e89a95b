// Tank treading at 3 /s, 2562 nodes, 25 strain units: the shipped case against its acceptance, and half the step.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/summary.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class ValidationTankTreading : public Program {
  protected:
    [[nodiscard]] output::Summary summary_of(const std::string& extra) const {
        const Outcome outcome =
            run("run '" HEMOFLUX_CASES "/tank_treading.toml' --threads 2 --quiet --output out " + extra);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return output::read_summary(folder_ / "out" / "summary.json");
    }
};

}  // namespace

TEST_F(ValidationTankTreading, MeetsItsReferencesAndHalvingTheStepChangesLittle) {
    const output::Summary s = summary_of("");
    for (const output::Comparison& c : output::compare(s))
        EXPECT_EQ(c.verdict, output::Comparison::Verdict::inside) << c.name << " " << c.value;
    EXPECT_LE(s.conservation.volume, 2e-4);
    EXPECT_LE(s.conservation.area, 5e-4);
    EXPECT_LE(std::abs(s.conservation.mean_density_per_strain), 1e-4);
    EXPECT_LE(s.conservation.centroid_um, 0.02);
    EXPECT_LE(s.performance.residuals_per_strain, 700);

    const output::Summary half =
        summary_of("--set numerics.step_strain=0.000734 --set output.pictures=false");
    EXPECT_NEAR(half.observables.at("inclination_deg"), s.observables.at("inclination_deg"), 0.2);
    std::printf("inclination %.3f and %.3f degrees, period %.3f and %.3f strain units (step and half)\n",
                s.observables.at("inclination_deg"), half.observables.at("inclination_deg"),
                s.observables.at("period_strain"), half.observables.at("period_strain"));
}

}  // namespace hemoflux::apps
