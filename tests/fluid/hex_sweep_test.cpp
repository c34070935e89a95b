#include "fluid/hex_sweep.hpp"

#include <gtest/gtest.h>

#include "fluid/hex_residual.hpp"
#include "hex_flows.hpp"

namespace hemoflux::fluid {
namespace {

constexpr std::uint32_t nothing = ~0u;

meshing::HexGrid grid_of(const std::string& periodic) {
    meshing::BoxDistortion distortion;
    distortion.random = 0.3;
    distortion.shuffle = true;
    return test::box_grid({1, 1, 1}, {12, 9, 7}, periodic, distortion);
}

}  // namespace

class HexSweepOf : public ::testing::TestWithParam<std::tuple<std::string, std::size_t>> {};
INSTANTIATE_TEST_SUITE_P(Stages, HexSweepOf,
                         ::testing::Combine(::testing::Values("", "z", "xyz"),
                                            ::testing::Values(1u, 7u, 64u, 100u, 10000u)));

// Plays a piece of the sweep and follows what lies in every place: whatever a stage reads must still be there.
void play(const meshing::HexGrid& grid, const HexSweep& sweep, std::size_t first, std::size_t last) {
    const std::size_t cells = grid.cells(), interior = grid.interior_faces();
    std::vector<std::uint32_t> record(sweep.cell_records, nothing), ghost(sweep.ghost_records, nothing),
        flux(sweep.fluxes, nothing), number(grid.faces());
    for (std::uint32_t k = 0; k < grid.faces(); ++k) number[sweep.faces[k]] = k;
    const std::size_t warm_up = sweep.stages[first].warm_up;
    for (std::size_t s = warm_up; s < last; ++s) {
        const HexStage& stage = sweep.stages[s];
        const std::size_t from = s == warm_up ? stage.lowest : stage.gradients.first;
        ASSERT_TRUE(from % gradient_block == 0 || from == cells);
        for (std::size_t c = from; c < stage.gradients.last; ++c)
            record[c % sweep.cell_records] = static_cast<std::uint32_t>(c);
        for (std::size_t k = stage.ghosts.first; k < stage.ghosts.last; ++k) {
            const std::uint32_t b = sweep.border[k], cell = grid.left[interior + b];
            ASSERT_EQ(record[cell % sweep.cell_records], cell);
            ghost[k % sweep.ghost_records] = b;
        }
        std::size_t next_ghost = stage.ghosts.first;
        for (std::size_t k = stage.faces.first; k < std::min(stage.faces.last, grid.faces()); ++k) {
            const std::uint32_t f = sweep.faces[k];
            ASSERT_EQ(record[grid.left[f] % sweep.cell_records], grid.left[f]);
            if (f < interior)
                ASSERT_EQ(record[grid.right[f] % sweep.cell_records], grid.right[f]);
            else
                ASSERT_EQ(ghost[next_ghost++ % sweep.ghost_records], f - interior);
            flux[k % sweep.fluxes] = f;
        }
        for (std::size_t c = stage.cells.first; s >= first && c < stage.cells.last; ++c)
            for (std::size_t j = grid.first_face[c]; j < grid.first_face[c + 1]; ++j)
                ASSERT_EQ(flux[number[grid.face[j]] % sweep.fluxes], grid.face[j]);
    }
}

TEST_P(HexSweepOf, FindsInEveryPlaceWhatItNeeds) {
    const auto& [periodic, stage_cells] = GetParam();
    const meshing::HexGrid grid = grid_of(periodic);
    const HexSweep sweep = plan_sweep(grid, stage_cells);
    const std::size_t stages = sweep.stages.size();
    for (const std::size_t pieces : {1u, 2u, 5u})
        for (std::size_t p = 0; p < pieces; ++p)
            if (stages * p / pieces < stages * (p + 1) / pieces)
                play(grid, sweep, stages * p / pieces, stages * (p + 1) / pieces);
}

TEST_P(HexSweepOf, ComputesEverythingOnce) {
    const auto& [periodic, stage_cells] = GetParam();
    const meshing::HexGrid grid = grid_of(periodic);
    const HexSweep sweep = plan_sweep(grid, stage_cells);
    std::size_t gradients = 0, ghosts = 0, faces = 0, balances = 0;
    for (const HexStage& stage : sweep.stages) {
        EXPECT_EQ(stage.gradients.first, gradients);
        EXPECT_EQ(stage.ghosts.first, ghosts);
        EXPECT_EQ(stage.faces.first, faces);
        EXPECT_EQ(stage.cells.first, balances);
        EXPECT_EQ(stage.faces.first % face_block, 0u);
        gradients = stage.gradients.last;
        ghosts = stage.ghosts.last;
        faces = stage.faces.last;
        balances = stage.cells.last;
    }
    EXPECT_EQ(gradients, grid.cells());
    EXPECT_EQ(ghosts, grid.border_faces());
    EXPECT_EQ(faces, exchange::round_up(grid.faces(), face_block));
    EXPECT_EQ(balances, grid.cells());
}

TEST(HexSweep, KeepsNoMoreThanAFewBandwidths) {
    const meshing::HexGrid grid = test::box_grid({1, 1, 8}, {8, 8, 64}, "");
    std::size_t bandwidth = 0;
    for (std::size_t f = 0; f < grid.interior_faces(); ++f)
        bandwidth = std::max<std::size_t>(bandwidth, grid.right[f] - grid.left[f]);
    const HexSweep sweep = plan_sweep(grid, 128);
    ASSERT_LT(10 * bandwidth, grid.cells());
    EXPECT_LE(sweep.cell_records, bandwidth + 128 + 2 * gradient_block);
    EXPECT_LE(sweep.fluxes, 4 * (bandwidth + 128) + 2 * face_block);
}

TEST(HexSweep, ResidualDoesNotDependOnStagesOrPieces) {
    const meshing::HexGrid grid = grid_of("z");
    HexPatches patches;
    for (const char* name : {"x-", "x+", "y-"}) patches[name] = wall_patch();
    patches["y+"] = velocity_patch([](const Vec3d&) { return Vec3d{0.05, 0, 0}; });
    const HexBoundary boundary(grid, patches);
    FlowParameters p;
    p.nu = 0.1;
    std::vector<double> start(4 * (grid.cells() + grid.border_faces()), 0.0), whole;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Vec3d& x = grid.centre[c];
        start[4 * c] = 1 + 0.01 * std::sin(7 * x.x + x.y);
        start[4 * c + 1] = 0.05 * std::sin(5 * x.y);
        start[4 * c + 2] = 0.05 * std::cos(6 * x.z);
        start[4 * c + 3] = 0.05 * x.x * x.y;
    }
    for (const std::size_t stage_cells : {10000u, 1u, 100u})
        for (const std::size_t rings : {1u, 3u}) {
            const HexGeometry geometry(grid, GradientMethod::least_squares, 1, idle_faces(grid, patches),
                                       stage_cells);
            exchange::Buffer<double> values(start), records(16 * geometry.records() * rings),
                flux(4 * geometry.fluxes() * rings), rate(4 * grid.cells());
            evaluate_hex_residual(geometry, boundary.view(), p,
                                  {values.data(), nullptr, records.data(), flux.data(), rate.data(), rings});
            if (whole.empty()) whole = rate.to_host();
            EXPECT_EQ(rate.to_host(), whole) << stage_cells << " " << rings;
        }
}

}  // namespace hemoflux::fluid
