"""Runs of scenes."""
import collections.abc
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
    """Progress of a run."""

    step: int  #: number of the equilibrium that is being computed, or was just saved
    n_steps: int  #: number of equilibria of the whole run
    branch: str  #: branch of the load path
    pressure: float  #: pressure that is imposed in this step
    solid_fraction: float
    time: float  #: simulated time since the beginning of the run
    equilibrium: bool  #: whether an equilibrium was just saved


class Run:
    """The directory of a run, as a sequence of its states: ``run[0]`` is the first state, ``run[-1]`` the last."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        if not self.directory.is_dir():
            raise InputError(f"{directory}: this is not a directory: expected a directory that floc run wrote")

    @property
    def states(self):
        """Paths of the state files, in the order of their numbers."""
        found = (path for path in self.directory.iterdir() if re.fullmatch(r"state-\d+\.h5", path.name))
        return sorted(found, key=lambda path: int(path.stem.split("-")[1]))

    @property
    def path(self):
        """The table path.csv as a dict with one array per column. Columns of numbers have NaN in empty cells."""
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
        track_contacts=None, track_energy=False, resume=False, overwrite=False, timing=True, prices=None):
    """Runs a scene: assembles a packing, brings it to equilibrium and loads it, as ``floc run`` does.

    Ctrl-C, or an exception that `on_progress` raises, stops the run at a checkpoint; ``resume=True`` continues from
    there with bit-identical results. Other Python threads continue during the run. Only the main thread of Python
    receives signals.

    Parameters
    ----------
    scene : path-like
        Scene file.
    directory : path-like
        Directory for states, path.csv and checkpoints.
    on_progress : callable, optional
        Function that is called with a `Progress` at each equilibrium and, every `interval` seconds, inside a step.
    interval : float
        Wall time between two calls of `on_progress` inside a step (s).
    changes : dict, optional
        Keys of the scene to change and their values, such as ``{"run.seed": 2, "load.0.to": 10.0}``.
    seed, threads, until : int, optional
        Seed, number of threads, and number of the last equilibrium to compute, as the options ``--seed``,
        ``--threads`` and ``--until``. A warning is issued if there are too few grains for this number of threads.
    track_contacts : float, optional
        Interval of simulated time at which contacts.csv records which contacts have opened and closed; not with
        `track_energy`.
    track_energy : bool
        Whether energy.csv records the energy balance of the run.
    resume, overwrite : bool
        Whether to continue the run in the directory, if there is one, or to replace it.
    timing : bool
        Whether path.csv has the duration of each step. Without durations, equal runs write equal files.
    prices : path-like, optional
        Table of the errors and costs of numerical settings, written by ``floc tradeoff``, as for the option ``--prices``.
        The table ``[accuracy]`` of the scene chooses settings from it [the table shipped with floc].

    Returns
    -------
    Run

    Raises
    ------
    InputError
        If the scene cannot be run (the message names file, line and key), or if the directory already has a run.
    NumericalError
        If a step does not converge; the run can be resumed.
    KeyboardInterrupt
        After Ctrl-C, as soon as a checkpoint is written.
    """
    told = None
    if on_progress is not None:
        if not callable(on_progress):
            raise InputError(f"on_progress = {on_progress!r}: expected a function")

        def told(*values):
            on_progress(Progress(*values))
    _core.run(os.fspath(scene), os.fspath(directory),
              changes=changes_of(changes),
              prices="" if prices is None else os.fspath(prices), seed=seed, threads=threads,
              until=until, track_contacts=track_contacts, track_energy=track_energy, resume=resume,
              overwrite=overwrite, timing=timing, told=told, interval=interval)
    return Run(directory)


def changes_of(changes):
    """Returns the changes of a scene, a dict or None, as texts KEY=VALUE."""
    if changes is None:
        return []
    if not isinstance(changes, collections.abc.Mapping):
        raise InputError(f"changes = {changes!r}: expected a dict of keys of the scene and their values")
    return [f"{key}={_toml(value)}" for key, value in changes.items()]


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
