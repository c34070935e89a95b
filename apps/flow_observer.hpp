/// Measures a flow as [observables] and [[profile]] of its case say, in units of a reference speed and length.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/plot.hpp"
#include "apps/output/summary.hpp"
#include "fluid/flow.hpp"
#include "fluid/probe.hpp"

namespace hemoflux::apps {

/// The box around a flow, um.
struct FlowBox {
    Vec3d lower, upper;
};

/// Takes the observables of a flow at its end and writes and draws its profiles.
class FlowObserver {
  public:
    /// Reads the reference profiles. gamma: of the solver, p = gamma rho / 3. InputError when they cannot be compared
    /// with, when a patch is not there or there is no reference speed; FileError.
    FlowObserver(const Case& c, const Scales& scales, const FlowBox& box, double gamma,
                 const fluid::Flow& flow);

    /// Measures the flow as it stands, puts the observables into the summary (FIELD_profile_rms, and those of
    /// cavities and bodies) and writes centreline_u.csv, centreline_v.csv, wall.csv, and plots of the profiles where
    /// the case wants pictures. Returns a line to print when a plot failed.
    std::string observe(output::Summary& summary, const output::OutputFolder& folder) const;

    /// Draws the flow in units of speed and length: picture_velocity.png with streamlines, picture_vorticity.png at the
    /// levels of Table 3.7 and picture_streamfunction.png for plane flows (near a body where there is one),
    /// picture_streamlines_{x,y,z}.png in the middle planes of the box for others. Returns a line to print when a
    /// picture failed.
    [[nodiscard]] std::string draw(const output::OutputFolder& folder) const;

    /// Reference speed (um/s) and length (um).
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] double length() const { return length_; }

  private:
    /// Reference values along one line; positions and values in reference units.
    struct Line {
        const ProfileInput* input;
        std::vector<double> position, value;
    };
    /// Ends of the line of a profile through the box.
    [[nodiscard]] std::array<Vec3d, 2> ends(const ProfileInput& in) const;
    void compare_profiles(const fluid::Probe& probe, output::Summary& summary) const;
    void observe_cavity(const fluid::Probe& probe, output::Summary& summary,
                        const output::OutputFolder& folder) const;
    std::string plot_profiles(const fluid::Probe& probe, const output::OutputFolder& folder) const;

    const Case& case_;
    Scales scales_;
    FlowBox box_;
    double gamma_;
    const fluid::Flow& flow_;
    double speed_, length_;
    std::vector<Line> lines_;
};

}  // namespace hemoflux::apps
