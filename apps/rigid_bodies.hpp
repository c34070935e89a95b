/// The rigid bodies of a case: built, coupled, measured, written and restored.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "apps/output/checkpoint.hpp"
#include "coupling/loop.hpp"
#include "coupling/rigid_body.hpp"

namespace hemoflux::apps {

/// The bodies of a run in the units of its case.
class RigidBodies {
  public:
    /// Builds the bodies and adds them to the loop, which must outlive them. InputError when one reaches out of the grid
    /// or its surface cannot be read. fluid: its options.
    RigidBodies(const Case& c, const Scales& scales, coupling::Loop& loop, const fluid::SolverOptions& fluid);

    /// "  body          name: 2562 nodes, 2.1 per cell face, ..." for the start-up summary, a line each.
    [[nodiscard]] std::string describe() const;

    /// Columns of history.csv and their values: per body, behind its name and a dot, x_um, y_um, z_um, force_x_N to
    /// torque_z_Nm of the fluid on it, angular_x_1_per_s to z, axis_x to z, no_slip_um_per_s.
    [[nodiscard]] std::vector<std::string> columns() const;
    [[nodiscard]] std::vector<double> row() const;

    /// Observables at the end of a run, of all but the first body behind its name and a dot: drag_coefficient,
    /// lift_coefficient, force_x_N .. torque_z_Nm, angular_velocity_z_1_per_s, no_slip_error (root mean square over the
    /// surface of the difference between the fluid's and the body's velocity, over `speed` or the largest speed of the
    /// surface or the flow), pressure_difference_pa between the ends of the body in the drag direction, and, where the
    /// body's axis has turned by more than half a turn in the xy plane, orbit_period_s and orbit_period_strain.
    /// The pressure at a smeared surface is not its own: see pressure_difference() in rigid_surface.hpp.
    /// rows: those of the history; first: the first column of columns() in them; the second column is the time in s.
    [[nodiscard]] std::map<std::string, double> observables(fluid::Flow& fluid,
                                                            const std::vector<std::vector<double>>& rows,
                                                            std::size_t first) const;

    /// Surfaces with the forces of the fluid on their nodes, pN, for the frames.
    struct Frame {
        std::vector<meshing::SurfaceMesh> meshes;
        std::vector<Vec3d> forces_pn;
    };
    /// The bodies as they are now.
    [[nodiscard]] Frame frame() const;

    /// State for a checkpoint, and back.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint);

    /// Number of bodies.
    [[nodiscard]] std::size_t size() const { return bodies_.size(); }
    /// The bodies themselves, in the order of the case.
    [[nodiscard]] std::vector<coupling::RigidBody*> all() const;

  private:
    [[nodiscard]] double newton() const { return scales_.pressure_pa * 1e-12; }
    [[nodiscard]] Vec3d axis(std::size_t body) const;

    const Case& case_;
    Scales scales_;
    const coupling::FluidGrid& grid_;
    fluid::SolverOptions fluid_;
    std::vector<double> cell_;  ///< width of the cells around each body, um
    std::vector<std::unique_ptr<coupling::RigidBody>> bodies_;
};

}  // namespace hemoflux::apps
