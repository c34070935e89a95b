/// The nodes of one rigid body on the device and the loops over them.
#pragma once

#include <memory>
#include <vector>

#include "coupling/body_motion.hpp"
#include "coupling/body_surface.hpp"
#include "exchange/buffer.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// Sums that tell how well the nodes follow the body: areas, and A |U_j - u_j|^2.
struct SlipSums {
    double area = 0, square = 0;
    HEMOFLUX_FN SlipSums& operator+=(const SlipSums& b) {
        area += b.area;
        square += b.square;
        return *this;
    }
};

/// Owns positions, areas, gains and forces of the nodes.
class BodyNodes {
  public:
    /// Nodes at the places of the surface, without forces or gains.
    explicit BodyNodes(const BodySurface& surface);
    ~BodyNodes();

    /// Number of nodes.
    [[nodiscard]] std::size_t size() const { return area_.size(); }
    /// Where the nodes are, um.
    [[nodiscard]] exchange::FieldView positions();
    /// F_j, on the fluid, rho_0 c^2 um^2.
    [[nodiscard]] exchange::FieldView forces();
    /// Scratch vector for the fluid's velocity, or its response, at the nodes.
    [[nodiscard]] exchange::FieldView velocities();
    /// Scratch vector of the nodes.
    [[nodiscard]] exchange::FieldView increments();

    /// Puts the nodes where the state says (um).
    void place(const BodyState& state);
    /// Fills `increments` with the area of each node in all three components.
    void areas_to_increments();
    /// K_j = share A_j.
    void set_uniform_gains(double share);
    /// K_j = A_j / (dt |r_j|), r_j the response in component x of `velocities` to a unit force per area.
    void set_gains_from_response(double dt);
    /// The largest |r_j|.
    [[nodiscard]] double largest_response();

    /// Sums for balance(), u the fluid's velocity at the nodes.
    NodeSums sums(const Vec3d& centre, const exchange::FieldView& u);
    /// F_j += K_j (U_j - u_j); the increment also into increments(), added to what is there when `add`.
    void correct(const BodyState& state, const exchange::FieldView& u, bool add);
    /// u_j = base_j + factor * velocities_j, in place of velocities.
    void combine(const exchange::FieldView& base, double factor);
    /// Sums over the nodes of how far the fluid's velocity u is from that of the body.
    SlipSums slip(const BodyState& state, const exchange::FieldView& u);

    /// Forces on the host and back, component by component.
    [[nodiscard]] std::vector<double> host_forces(int component) const { return force_[component].to_host(); }
    void set_forces(int component, const std::vector<double>& f) { force_[component].assign(f); }

  private:
    struct Scratch;
    exchange::Buffer<double> own_[3], position_[3], force_[3], velocity_[3], increment_[3];
    exchange::Buffer<double> area_, gain_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace hemoflux::coupling
