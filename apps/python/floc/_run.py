"""Runs of scenes."""
import csv
import dataclasses
import os
import pathlib
import re

import numpy as np

from . import _core
from ._errors import InputError
from ._state import read


@dataclasses.dataclass(frozen=True)
class Progress:
    """How far a run has come."""

    step: int  #: number of the equilibrium that is being made, or was just saved
    n_steps: int  #: equilibria of the whole run
    branch: str  #: of the load path
    pressure: float  #: that the step goes to
    solid_fraction: float
    time: float  #: simulated since the beginning
    equilibrium: bool  #: whether this is an equilibrium that was just saved


class Run:
    """The directory of a run, a sequence of its states: ``run[0]`` is the first, ``run[-1]`` the last."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        if not self.directory.is_dir():
            raise InputError(f"{directory}: is not a directory: expected a directory of floc run")

    @property
    def states(self):
        """Paths of the state files, in their order."""
        found = (path for path in self.directory.iterdir() if re.fullmatch(r"state-\d+\.h5", path.name))
        return sorted(found, key=lambda path: int(path.stem.split("-")[1]))

    @property
    def path(self):
        """path.csv as a dict of arrays by column: numbers where all are, NaN where a place is empty."""
        with open(self.directory / "path.csv", newline="", encoding="utf-8") as file:
            names, *rows = csv.reader(file)
        return {name: _column([row[k] for row in rows]) for k, name in enumerate(names)}

    def __len__(self):
        return len(self.states)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [read(path) for path in self.states[k]]
        return read(self.states[k])

    def __repr__(self):
        return f"<Run {str(self.directory)!r}: {len(self)} equilibria>"


def run(scene, directory, *, on_progress=None, interval=0.5, changes=None, seed=None, threads=None, until=None,
        track_contacts=None, track_energy=False, resume=False, overwrite=False, timing=True):
    """Assembles a packing, brings it to equilibrium and loads it as a scene says, as ``floc run`` does.

    Ctrl-C, or an exception that `on_progress` raises, stops the run at a checkpoint; ``resume=True`` continues from
    there, bit for bit. Other threads keep running meanwhile. Only the main thread of Python receives signals.

    Parameters
    ----------
    scene : path-like
        Scene file.
    directory : path-like
        For states, path.csv and checkpoints.
    on_progress : callable, optional
        Called with a `Progress` at each equilibrium, and inside a step now and then.
    interval : float
        Seconds between two calls inside a step.
    changes : dict, optional
        Keys of the scene to change, ``{"run.seed": 2, "load.0.to": 10.0}``.
    seed, threads, until : int, optional
        As ``--seed``, ``--threads`` and ``--until`` (the last equilibrium to make). A warning says where so few grains
        leave threads unused.
    track_contacts : float, optional
        Records in contacts.csv which contacts open and close, checking at this interval of simulated time.
    track_energy : bool
        Records the energy account in energy.csv.
    resume, overwrite : bool
        Continues the run in the directory (harmless on a first one), or replaces it.
    timing : bool
        Whether path.csv says how long each step took; without it, equal runs are equal files.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        If the scene cannot be run (the message names file, line and key) or the directory holds a run already.
    NumericalError
        If a step does not converge; the run can be resumed.
    KeyboardInterrupt
        After Ctrl-C, once a checkpoint is written.
    """
    told = None
    if on_progress is not None:
        def told(*values):
            on_progress(Progress(*values))
    _core.run(os.fspath(scene), os.fspath(directory),
              changes=[f"{key}={_toml(value)}" for key, value in (changes or {}).items()], seed=seed, threads=threads,
              until=until, track_contacts=track_contacts, track_energy=track_energy, resume=resume,
              overwrite=overwrite, timing=timing, told=told, interval=interval)
    return Run(directory)


def _toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, np.generic):
        value = value.item()
    return value if isinstance(value, str) else repr(value)


def _column(cells):
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)
