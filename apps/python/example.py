# %% [markdown]
# A red blood cell in shear flow, from Python: a case of one's own, a run, arrays; the same step by step; the cell alone.
# Run it as it is (python3 apps/python/example.py) or cell by cell in an editor that knows `# %%`.

# %% A case: TOML text with units, and changes to it
import tempfile
from pathlib import Path

import numpy as np

import hemoflux as hf

CASE = """
title = "Tank treading, coarse"
kind = "coupled"
[fluid]
viscosity = "22 mPa s"
[grid]
kind = "plateau"
length = ["12 um", "12 um", "12 um"]
cells = [20, 20, 20]
plateau = { a = 7, b = 0.3 }
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
strain = 1
[output]
interval_strain = 0.5
"""
case = hf.Case.from_text(CASE, {"shear.rate": "5 1/s"})
print(case, case.check(), sep="\n")

# %% A run into a folder, as the program makes it
with tempfile.TemporaryDirectory() as folder:
    result = hf.run(case, Path(folder) / "run", progress=lambda step, strain, end: print(f"\rstrain {strain:.2f}", end=""))
    print()
    history = result.history
    for name in ("strain", "0.inclination_deg", "0.volume_error"):
        print(f"{name:18}", np.array2string(history[name][::5], precision=4))
    print("conservation", result.summary["conservation"])
    assert 5 < history["0.inclination_deg"][-1] < 30

# %% The same in memory, step by step
sim = hf.Simulation(case)
for _ in range(4):
    sim.step(sim.planned_steps // 4)
    print({name: round(value, 4) for name, value in sim.observe().items() if name in ("strain", "0.inclination_deg")})
assert sim.history["0.inclination_deg"][-1] == history["0.inclination_deg"][-1]  # bit for bit
nodes, triangles = sim.nodes(), sim.triangles()
disturbance = sim.velocity[..., 0] - 5 * sim.centres[..., 1]  # of u = G y; arrays are (z, y, x)
print("nodes", nodes.shape, "triangles", triangles.shape, "velocity", sim.velocity.shape)
print(f"the cell disturbs the flow by up to {np.abs(disturbance).max():.2f} um/s")

# %% The cell alone, pulled by optical tweezers
cell = hf.Membrane(case)
table = cell.stretch([0, 50, 100])
for force, axial, transverse in zip(table["force_pN"], table["axial_um"], table["transverse_um"]):
    print(f"{force:5.0f} pN  axial {axial:.2f} um  transverse {transverse:.2f} um")
