"""The Python package against exact flows, against itself in a folder, and against differences of its own energies."""

import os
import signal
import tempfile
import unittest
from pathlib import Path

import numpy as np

import hemoflux as hf

COUETTE = """
title = "Shear between plates"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
initial = "shear"
[grid]
length = ["4 um", "10 um", "6 um"]
cells = [4, 10, 6]
[boundary]
x = "periodic"
z = "periodic"
y = { velocity = "shear" }
[shear]
rate = "1000 1/s"
[time]
strain = 0.5
[output]
pictures = false
"""

CELL = """
title = "A coarse cell in shear"
kind = "coupled"
[fluid]
viscosity = "22 mPa s"
[grid]
length = ["12 um", "12 um", "12 um"]
cells = [16, 17, 18]
[boundary]
x = { velocity = "shear" }
y = { velocity = "shear" }
z = { velocity = "shear" }
[shear]
rate = "3 1/s"
[[cell]]
mesh = "icosphere"
nodes = 162
shape = "discocyte"
reference = "uniform"
shear_modulus = "6.1 uN/m"
cytosol_viscosity = "6 mPa s"
position = ["0 um", "0 um", "0 um"]
axis = [0, 1, 0]
[time]
strain = 0.1
[output]
interval_strain = 0.05
history_interval_strain = 0.05
checkpoint_interval_strain = 0.05
"""


def volume(nodes, triangles):
    a, b, c = (nodes[triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def centroid(nodes, triangles):
    a, b, c = (nodes[triangles[:, i]] for i in range(3))
    weight = np.einsum("ij,ij->i", a, np.cross(b, c))
    return (weight[:, None] * (a + b + c)).sum(axis=0) / (4 * weight.sum())


class Cases(unittest.TestCase):
    def test_overrides_reach_the_resolved_case_which_reads_back_equal(self):
        case = hf.Case.from_text(CELL, {"shear.rate": "5 1/s", "cell.0.nodes": 642, "coupling.recentre": True})
        self.assertEqual((case.kind, case.cells, case.title), ("coupled", 1, "A coarse cell in shear"))
        for line in ('rate = "5 1/s"', "nodes = 642", "recentre = true"):
            self.assertIn(line, case.resolved)
        self.assertEqual(hf.Case.from_text(case.resolved).resolved, case.resolved)
        self.assertEqual(hf.Case.from_text(CELL, ["cell.0.nodes=642"]).resolved.count("nodes = 642"), 1)

    def test_files_are_read_and_paths_seen_from_their_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "case.toml"
            file.write_text(CELL)
            self.assertEqual(hf.Case.from_file(file).resolved, hf.Case.from_text(CELL).resolved)
            with self.assertRaises(OSError) as caught:
                hf.Case.from_file(Path(folder) / "none.toml")
            self.assertIsInstance(caught.exception, hf.FileError)
            self.assertIn("none.toml", str(caught.exception))

    def test_bad_input_is_a_value_error_that_names_the_key(self):
        with self.assertRaises(ValueError) as caught:
            hf.Case.from_text(CELL.replace("shear_modulus", "shear_moduls"))
        self.assertIsInstance(caught.exception, hf.InputError)
        self.assertIn("shear_modulus", str(caught.exception))
        with self.assertRaises(hf.InputError):
            hf.Case.from_text(CELL, {"cell.0.position": ["5 um", "0 um", "0 um"]}).check()
        with self.assertRaises(hf.InputError):
            hf.Membrane(hf.Case.from_text(CELL), 1)


class Fluid(unittest.TestCase):
    def test_arrays_hold_the_exact_shear_flow(self):
        sim = hf.Simulation(hf.Case.from_text(COUETTE))
        self.assertEqual(sim.velocity.shape, (6, 10, 4, 3))
        self.assertEqual(sim.density.shape, (6, 10, 4))
        x = sim.centres
        np.testing.assert_allclose(x[2, 3, 1], [-0.5, -1.5, -0.5])  # z, y, x of the box about the origin
        sim.step(20)
        self.assertEqual(sim.steps, 20)
        self.assertAlmostEqual(sim.strain, 1000 * sim.time)
        np.testing.assert_allclose(sim.velocity[..., 0], 1000 * x[..., 1], atol=1e-8)
        np.testing.assert_allclose(sim.velocity[..., 1:], 0, atol=1e-8)
        np.testing.assert_allclose(sim.density, 1000, rtol=1e-12)
        self.assertEqual(sim.cells, 0)
        with self.assertRaises(hf.InputError):
            sim.nodes()

    def test_a_run_leaves_summary_and_history(self):
        with tempfile.TemporaryDirectory() as folder:
            seen = []
            result = hf.run(hf.Case.from_text(COUETTE), folder, threads=1, progress=lambda *at: seen.append(at))
            self.assertFalse(result.interrupted)
            self.assertAlmostEqual(result.history["largest_speed_um_per_s"][-1], 1000 * 4.5, places=6)
            self.assertAlmostEqual(result.summary["observables"]["time_s"], 0.5e-3)
            self.assertEqual(seen[-1][1], seen[-1][2])
            self.assertEqual(seen, sorted(seen))


class Coupled(unittest.TestCase):
    def setUp(self):
        self.case = hf.Case.from_text(CELL)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_stepping_gives_what_a_run_into_a_folder_gives(self):
        result = hf.run(self.case, self.folder / "run")
        sim = hf.Simulation(self.case)
        start = volume(sim.nodes(), sim.triangles())
        sim.observe()
        sim.step(sim.planned_steps)
        now = sim.observe()
        stored = result.simulation()
        self.assertEqual(stored.steps, sim.steps)
        np.testing.assert_array_equal(stored.nodes(), sim.nodes())
        np.testing.assert_array_equal(stored.velocity, sim.velocity)
        np.testing.assert_array_equal(stored.density, sim.density)
        history = result.history
        for name in ("step", "strain", "0.x_um", "0.inclination_deg", "0.energy_aJ", "0.volume_error", "mean_density"):
            self.assertEqual(history[name][-1], now[name], name)
        self.assertAlmostEqual(volume(sim.nodes(), sim.triangles()) / start - 1, now["0.volume_error"], places=12)
        self.assertEqual(list(sim.history["step"]), [0, sim.steps])
        self.assertLess(np.abs(sim.forces().sum(axis=0)).max(), 1e-9)
        stored.step(3)
        sim.step(3)
        np.testing.assert_array_equal(stored.nodes(), sim.nodes())

    def test_a_run_stopped_by_its_caller_continues_bitwise(self):
        whole = hf.run(self.case, self.folder / "whole").simulation()
        stopped = hf.run(self.case, self.folder / "part", progress=lambda *at: False)
        self.assertTrue(stopped.interrupted)
        self.assertLess(stopped.simulation().steps, whole.steps)
        go_on = hf.run(self.case, self.folder / "part", restart=self.folder / "part")
        np.testing.assert_array_equal(go_on.simulation().nodes(), whole.nodes())

    def test_what_the_caller_raises_comes_back(self):
        def fail(*at):
            raise KeyError("mine")

        def interrupt(*at):
            os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyError):
            hf.run(self.case, self.folder / "failed", progress=fail)
        # a shell starts what runs in its background with SIGINT ignored, and then Python installs no handler
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        with self.assertRaises(KeyboardInterrupt):
            hf.run(self.case, self.folder / "interrupted", progress=interrupt)
        self.assertGreater(hf.Simulation.from_folder(self.folder / "interrupted").steps, 0)

    def test_a_step_too_long_is_a_runtime_error(self):
        sim = hf.Simulation(hf.Case.from_text(CELL, {"numerics.step_strain": 0.1, "time.strain": 100}))
        with self.assertRaises(RuntimeError) as caught:
            sim.step(500)
        self.assertIsInstance(caught.exception, hf.NumericalError)

    def test_an_output_that_cannot_be_made_is_an_os_error(self):
        (self.folder / "file").write_text("")
        with self.assertRaises(OSError):
            hf.run(self.case, self.folder / "file" / "run")


class Alone(unittest.TestCase):
    def test_forces_are_minus_the_gradient_of_the_energy(self):
        cell = hf.Membrane(hf.Case.from_text(CELL))
        rest = cell.nodes
        self.assertEqual(rest.shape, (162, 3))
        rng = np.random.default_rng(1)
        at = rest + 0.02 * rng.standard_normal(rest.shape)
        way = rng.standard_normal(rest.shape)
        step = 1e-5

        def energy(nodes):
            cell.nodes = nodes
            return cell.energies["total"]

        slope = (energy(at + step * way) - energy(at - step * way)) / (2 * step)  # aJ/um = pN
        cell.nodes = at
        np.testing.assert_array_equal(cell.nodes, at)
        self.assertAlmostEqual(-np.sum(cell.forces * way) / slope, 1, places=6)

    def test_relaxed_and_stretched(self):
        cell = hf.Membrane(hf.Case.from_text(CELL))
        self.assertLess(cell.relax()["largest_force_pN"], 1e-3)
        self.assertLess(np.abs(cell.forces).max(), 1e-3)
        self.assertAlmostEqual(volume(cell.nodes, cell.triangles), cell.measures["volume_um3"], places=9)
        table = cell.stretch([0, 20, 40])
        np.testing.assert_array_equal(table["force_pN"], [0, 20, 40])
        self.assertTrue(np.all(np.diff(table["axial_um"]) > 0))
        self.assertTrue(np.all(np.diff(table["transverse_um"]) < 0))
        away = cell.nodes - centroid(cell.nodes, cell.triangles)
        self.assertAlmostEqual(2 * np.linalg.norm(away, axis=1).max(), table["axial_um"][-1], places=9)

    def test_nodes_out_of_shape_are_refused(self):
        cell = hf.Membrane(hf.Case.from_text(CELL))
        with self.assertRaises(ValueError):
            cell.nodes = cell.nodes[:-1]
        cell.nodes = 4 * cell.nodes
        with self.assertRaises(hf.NumericalError):
            cell.forces


if __name__ == "__main__":
    unittest.main()
