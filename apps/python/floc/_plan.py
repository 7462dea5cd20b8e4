"""Plans for a budget or for wanted errors."""
import collections.abc
import os

from . import _core
from ._errors import InputError
from ._records import Record, Records, records, with_columns
from ._run import changes_of
from ._state import number


@with_columns("plan")
class Plan(Record):
    """The expected error of one observable with one plan: a row of ``floc plan``."""


@with_columns("plan --check")
class PlanCheck(Record):
    """The promised and the achieved error of one quantity: a row of ``floc plan --check``."""


class Plans(Records):
    """The rows of the best plans, the best one first. ``remarks`` has the remarks that ``floc plan`` prints."""

    def __init__(self, rows, remarks):
        super().__init__(rows)
        self.remarks = remarks


def plan(scene, *, budget=None, want=None, cores=1, observables=(), changes=None, prices=None, pilot=False,
         output=None, overwrite=False):
    """Chooses the number of grains, the number of samples and the settings of a scene, as ``floc plan`` does.

    Parameters
    ----------
    scene : path-like
        Scene file.
    budget : str or float, optional
        Time that the runs may take on all cores together: with a unit, such as ``"2h"``, or in seconds.
    want : dict, optional
        Largest accepted relative errors, such as ``{"phi": 0.003, "B": 0.03}``. A budget or a wanted error is required.
    cores : int
        Number of cores, each of which makes one sample at a time.
    observables : sequence of str
        Observables whose errors are to be small where none are wanted [all].
    changes : dict, optional
        Keys of the scene to change and their values, as in `run`.
    prices : path-like, optional
        Table of the errors and costs of numerical settings, written by ``floc tradeoff`` [the table shipped with floc].
    pilot : bool
        Whether to run a few small samples of the scene first, and to take costs and scatter from them.
    output : path-like, optional
        File to write for the best plan: a campaign file, or a scene file if the plan has only one sample.
    overwrite : bool
        Whether `output` may replace an existing file. It never replaces the scene file.

    Returns
    -------
    Plans
        One row for each plan and observable.

    Raises
    ------
    InputError
        If the scene, the budget or a wanted error is refused; the message names the nearest that can be had. If `output`
        exists already and may not be replaced.
    NumericalError
        If a sample of the pilot does not converge.

    Notes
    -----
    docs/accuracy.md, "A plan for a budget".
    """
    if want is not None and not isinstance(want, collections.abc.Mapping):
        raise InputError(f"want = {want!r}: expected a dictionary of relative errors, such as {{'phi': 0.003}}")
    if observables and want:
        raise InputError("observables: this argument cannot be combined with want: expected only one of them")
    table, remarks = _core.plan(
        os.fspath(scene), changes=changes_of(changes), prices="" if prices is None else os.fspath(prices),
        budget=_budget(budget), want=[f"{name}={number('want', error)!r}" for name, error in (want or {}).items()],
        cores=cores, observables=observables, pilot=pilot, output="" if output is None else os.fspath(output),
        overwrite=overwrite)
    return Plans(records(Plan, table, None, False), remarks)


def check_plan(directory):
    """Compares the runs of a campaign that `plan` has written with what it promised, as ``floc plan --check`` does.

    Parameters
    ----------
    directory : path-like
        Directory of the campaign, made by ``floc campaign plan``.

    Returns
    -------
    list of PlanCheck
        One for each observable, and one for the cost.
    """
    return records(PlanCheck, _core.check_plan(os.fspath(directory)), None, False)


def _budget(budget):
    if budget is None:
        return ""
    return budget if isinstance(budget, str) else repr(number("budget", budget))
