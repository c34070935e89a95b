"""Red blood cells in flow, from Python.

    import hemoflux as hf
    case = hf.Case.from_file("apps/cases/tank_treading_quick.toml", {"shear.rate": "5 1/s", "cell.0.nodes": 162})
    case.check()
    result = hf.run(case, "results/mine", progress=print)     # writes what the program writes
    result.history["0.inclination_deg"]                       # NumPy arrays
    sim = hf.Simulation(case)                                 # or step by step, in memory
    sim.step(100)
    sim.nodes(), sim.triangles(), sim.velocity, sim.density, sim.observe()
    hf.Membrane(case).stretch([0, 50, 100])                   # a cell alone

Errors: InputError (a ValueError), NumericalError (a RuntimeError), FileError (an OSError). A message says what is wrong, why,
and what to do. Pictures are drawn by the program `hemoflux` only.
"""

import json
import os
import warnings
from pathlib import Path

# Waiting threads of GCC's OpenMP spin, which slows a machine that does other work too; read when the module is loaded.
if "OMP_WAIT_POLICY" not in os.environ:
    os.environ.setdefault("GOMP_SPINCOUNT", "1000")

from . import _core
from ._core import (
    Case,
    FileError,
    InputError,
    Membrane,
    NumericalError,
    Simulation,
    backend,
    read_history,
    set_threads,
    threads,
)

__version__ = _core.__version__
__all__ = [
    "Case",
    "FileError",
    "InputError",
    "Membrane",
    "NumericalError",
    "Result",
    "Simulation",
    "backend",
    "read_history",
    "run",
    "set_threads",
    "threads",
]


def _assignments(overrides):
    """Overrides as the command line has them: {"shear.rate": "5 1/s"} or ["shear.rate=5 1/s"]."""
    if not isinstance(overrides, dict):
        return list(overrides or [])
    return [f"{key}={value if isinstance(value, str) else json.dumps(value)}" for key, value in overrides.items()]


def _from_file(file, overrides=None):
    """Reads a case file. overrides: a dict from key to value ("cell.0.nodes": 642), or texts "key=value".

    Raises FileError when it cannot be read, InputError when a key, unit or value is wrong."""
    return Case._from_file(file, _assignments(overrides))


def _from_text(text, overrides=None, folder=".", name="case"):
    """The same from TOML text. folder: where relative paths begin; name: what messages call the text."""
    return Case._from_text(text, name, Path(folder).absolute(), _assignments(overrides))


Case.from_file = staticmethod(_from_file)
Case.from_text = staticmethod(_from_text)


class Result:
    """The output folder of a run: what it holds, as Python objects."""

    def __init__(self, folder, interrupted=False):
        self.folder = Path(folder)
        #: Whether the run was stopped before its end; run(case, folder, restart=folder) goes on.
        self.interrupted = interrupted

    @property
    def summary(self):
        """summary.json as a dict: observables, conservation, references, performance."""
        return json.loads(self._file("summary.json").read_text(encoding="utf-8"))

    @property
    def history(self):
        """history.csv as a dict from the name of each column to its array."""
        return read_history(self._file("history.csv"))

    def table(self, name):
        """Another CSV file of the folder, such as "stretch.csv", likewise."""
        return read_history(self._file(name))

    def simulation(self):
        """The state at the last checkpoint, for its arrays or to go on step by step."""
        return Simulation.from_folder(self.folder)

    def _file(self, name):
        return self.folder / name

    def __repr__(self):
        return f"<hemoflux.Result in {self.folder}{', interrupted' if self.interrupted else ''}>"


def run(case, output, threads=0, progress=None, restart=None, quiet=True):
    """Runs a case of any kind into the folder `output`, which then holds what the program leaves there.

    threads: 0 for HEMOFLUX_THREADS, else all cores. progress(step, position, end) is called about ten times a second and
    at the end, position and end in strain or seconds; when it returns False, or raises, the run writes a checkpoint and
    stops. restart: the folder of a run to continue. quiet=False prints what the program prints. Ctrl-C raises
    KeyboardInterrupt, after a checkpoint is written. What case.check() warns of becomes Python warnings."""
    for text in case.check():
        warnings.warn(text, stacklevel=2)
    code = _core._run(case, output, restart or "", threads, quiet, progress)
    return Result(output, interrupted=code == _core._interrupted)
