"""Moduli, networks, structure, comparisons, chains."""
import numpy as np

from . import _core
from ._records import Record, records, with_columns
from ._state import number, states_of, unmasked


@with_columns("moduli")
class Moduli(Record):
    """Elastic moduli, bounds and stability of a state: a row of ``floc moduli``."""


@with_columns("network")
class Network(Record):
    """The contact network of a state: a row of ``floc network``."""


@with_columns("structure")
class Structure(Record):
    """The structure of a state: a row of ``floc structure``."""


@with_columns("compare")
class Comparison(Record):
    """What changed between two states: a row of ``floc compare``."""


class Compliance(Record):
    """A compliance of a chain: formula, solved and error_bound."""


class Chain(Record):
    """Compliances of a chain of disks: axial, transverse, rolling, end_disk_deflection, each a `Compliance`."""


def moduli(state, strains="diagonal", *, prestress=False, tolerance=None, method="factor", accuracy=None,
           force_tolerance=None, rolling_stiffness=None, tables=(), force=False):
    """Elastic moduli, bounds and stability, as ``floc moduli`` prints them.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    strains : {"diagonal", "full"}
        With "diagonal" shear strains are clamped; "full" takes every component, which adds the shear moduli.
    prestress : bool
        Adds the geometric terms of the forces (except those of F_T); the stress is the Cauchy stress.
    tolerance : float, optional
        Relative error wanted of B and G [1e-10].
    method : {"factor", "single-factor", "iterative", "bounds"}
        The last three are approximate and come with errors.
    accuracy : float or dict, optional
        Relative errors of B and G that are good enough, ``1e-3`` or ``{"B": 1e-3}``; takes the cheapest method that keeps them.
    force_tolerance : float, optional
        Cohesionless packings: a contact below this force, in units of max(F0, P a^(d-1)), carries nothing [1e-5].
    rolling_stiffness : float or sequence of float, optional
        K_R of every touching contact in place of its own (force length). One row per value of a sequence.
    tables : sequence of str
        "increments": for each contact what a unit of isotropic and of deviatoric stress changes in it.
    force : bool
        Accepts states that are not in equilibrium, which are refused otherwise.

    Returns
    -------
    Moduli, or a list of them for a sequence of states or rolling stiffnesses

    Raises
    ------
    EquilibriumError
        If the state is not in equilibrium, unless `force`.
    NumericalError
        If there are no moduli, or none as accurate as asked.
    InputError

    Notes
    -----
    docs/physics.md, "Elastic moduli" and "Bounds"; the columns ``*_printed`` are the forms of [GRC2008].
    """
    states, single = states_of(state)
    several = rolling_stiffness is not None and np.ndim(rolling_stiffness) > 0
    rolling = [] if rolling_stiffness is None else list(np.atleast_1d(unmasked("rolling_stiffness", rolling_stiffness)))
    table, further = _core.moduli(
        states, strains=strains, prestress=prestress, tolerance=tolerance, method=method, accuracy=_accuracy(accuracy),
        force_tolerance=force_tolerance, rolling_stiffness=rolling, tables=_names(tables), force=force)
    return records(Moduli, table, further, single and not several)


def network(state, *, zero_force=None, least_contacts=None, unit="mean", bin_width=0.1, groups=(), near_zero=0.02,
            shuffles=20, pressure_bin_width=0.1, without=(), tables=()):
    """Coordination, forces, particle pressures and what carries the load, as ``floc network`` prints them.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    zero_force : float, optional
        Normal forces below this count as zero, in units of max(F0, P a^(d-1)) [the force tolerance of the state].
    least_contacts : int, optional
        Fewest contacts above that force for a grain of the force-carrying structure [2 where a contact carries a
        tangential force, else d + 1].
    unit : {"mean", "F0", "P"}, bin_width : float
        Unit and bin width of the table "pdf".
    groups : sequence of {"bonds", "phases"}
        Further columns.
    near_zero : float, shuffles : int, pressure_bin_width : float
        As ``--near-zero``, ``--shuffles`` and ``--pressure-bin-width``.
    without : sequence of {"mechanics"}
        Columns left as None: what needs the moduli, which takes most of the time in a large packing. They are None
        for a state with walls.
    tables : sequence of str
        "pdf", "particle_stress", "exponents", "pressure_pdf", "like_neighbours", "clusters".

    Returns
    -------
    Network, or a list of them for a sequence of states
    """
    states, single = states_of(state)
    table, further = _core.network(
        states, zero_force=zero_force, least_contacts=least_contacts, unit=unit, bin_width=bin_width,
        groups=_names(groups), near_zero=near_zero, shuffles=shuffles, pressure_bin_width=pressure_bin_width,
        without=_names(without), tables=_names(tables))
    return records(Network, table, further, single)


def structure(state, *, average=False, fit_range=(0.0, 1.0), largest_k=None, cells_per_wave=None, reach=5.0,
              map_size=(32, 32), probes=40, profile_axis=None, slices=20, tables=()):
    """Scattering with xi and dF, pores, local solid fractions, as ``floc structure`` prints them.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    average : bool
        Adds a last row for all states together, as samples of one ensemble.
    fit_range : (float, float)
        Wave numbers fitted, in 2 pi over the largest diameter.
    largest_k, cells_per_wave, reach, map_size, probes, profile_axis, slices
        As the options of the command.
    tables : sequence of str
        "intensity", "pair_correlation", "gaps", "pores", "map", "prediction", "porosity", "profile".

    Returns
    -------
    Structure, or a list of them for a sequence of states

    Raises
    ------
    InputError
        If the state has walls, and tables other than "pair_correlation", "porosity" and "profile" are asked for.
    """
    states, single = states_of(state)
    table, further = _core.structure(
        states, average=average, fit_range=fit_range, largest_k=largest_k, cells_per_wave=cells_per_wave,
        reach=reach, map_size=map_size, probes=probes, profile_axis=profile_axis, slices=slices,
        tables=_names(tables))
    return records(Structure, table, further, single)


def compare(before, after, *, rigid_tolerance=0.01, tables=()):
    """What changed between two states of the same grains, as ``floc compare`` prints it.

    Parameters
    ----------
    before, after : State or path-like
    rigid_tolerance : float
        Tolerance of a contact that moves as rigid: how far its two contact points may part, in largest diameters, and
        how much the rotations of its grains may differ, in radians.
    tables : sequence of str
        "displacements" (one row per grain) and "contacts" (one row per contact: kept, lost or gained).

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        If the grains are not the same.
    """
    (first,), _ = states_of(before)
    (second,), _ = states_of(after)
    table, further = _core.compare(first, second, rigid_tolerance=rigid_tolerance, tables=_names(tables))
    return records(Comparison, table, further, True)


def chain(n, R, kn, kt, kr, bend=0.0):
    """Compliances of a chain of equal disks, closed forms and the solved network, as ``floc chain`` prints them.

    Parameters
    ----------
    n : int
        Number of disks, 2 to 1000000.
    R : float
        Radius of the disks (length).
    kn, kt, kr : float
        K_N and K_T (force/length) and K_R (force length).
    bend : float
        Degrees by which each branch is turned against the one before; a bent chain has no closed form.

    Returns
    -------
    Chain
        Of axial, transverse, rolling and end_disk_deflection, each with formula, solved and error_bound: in
        length/force, rolling in 1/(force length).

    Notes
    -----
    docs/physics.md, "Chains of disks"; end_disk_deflection is Eq. 16 of [GRC2008] as it is printed.
    """
    names, rows = _core.chain(n, R, kn, kt, kr, bend)
    which = names.index("compliance")
    wanted = ("formula", "solved", "error_bound")
    compliances = {row[which]: Compliance(wanted, [row[names.index(name)] for name in wanted]) for row in rows}
    return Chain(compliances.keys(), compliances.values())


def _names(names):
    return [names] if isinstance(names, str) else list(names)


def _accuracy(accuracy):
    if accuracy is None:
        return []
    if isinstance(accuracy, dict):
        return [f"{name}={number('accuracy', error)!r}" for name, error in accuracy.items()]
    return [repr(number("accuracy", accuracy))]
