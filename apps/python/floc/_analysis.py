"""Functions for moduli, contact networks, structure, comparisons of states, and chains of disks."""
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
    """The changes between two states: a row of ``floc compare``."""


@with_columns("forces")
class Forces(Record):
    """Contact forces at rest for the geometry of a state: a row of ``floc forces``."""


class Compliance(Record):
    """A compliance of a chain: formula (closed form), solved (from the network) and error_bound (of solved)."""


class Chain(Record):
    """Compliances of a chain of disks: axial, transverse, rolling, end_disk_deflection, each a `Compliance`."""


def moduli(state, strains="diagonal", *, prestress=False, tolerance=None, method="factor", accuracy=None,
           force_tolerance=None, rolling_stiffness=None, kn=None, kt=None, stiffness_per="point", tables=(), force=False):
    """Computes elastic moduli, bounds and stability, as ``floc moduli`` prints them.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    strains : {"diagonal", "full"}
        "diagonal": shear strains are zero; "full": all components of the strain, which adds the shear moduli.
    prestress : bool
        Adds the geometric terms of the contact forces to the stiffness matrix (for disks and spheres, except the terms
        of the tangential forces); the stress of the moduli is then the Cauchy stress.
    tolerance : float, optional
        Largest relative error of B and G [1e-10].
    method : {"factor", "single-factor", "iterative", "bounds"}
        Method of solution. The last three methods are approximate; the result has their errors.
    accuracy : float or dict, optional
        Relative errors of B and G that are acceptable, such as ``1e-3`` or ``{"B": 1e-3}``. The cheapest method with
        smaller errors is chosen.
    force_tolerance : float, optional
        For packings without cohesion: a contact with a smaller force counts as open, in units of
        max(F0, P a^(d-1)) [1e-5].
    rolling_stiffness : float or sequence of float, optional
        Rolling stiffness K_R of every touching contact instead of the value in the state (force length). A sequence
        gives one row per value.
    kn, kt : float, optional
        Normal and tangential stiffness of the contacts of rigid grains, which have none of their own (force/length).
        Required for states of rigid grains (`kt` if they have friction) and refused for others. The moduli are then those
        of these springs, and not a property of the grains.
    stiffness_per : {"point", "contact"}
        What has the stiffnesses `kn` and `kt`: each contact point, or the contact of each pair of grains, whose contact
        points then have equal shares.
    tables : sequence of str
        Additional tables to compute. "increments": for each contact, the changes of its force under an isotropic and a
        deviatoric stress of 1.
    force : bool
        Whether to accept states that are not in equilibrium, with a warning.

    Returns
    -------
    Moduli, or a list of them for a sequence of states or rolling stiffnesses

    Raises
    ------
    EquilibriumError
        If the state is not in equilibrium, unless `force`.
    NumericalError
        If the packing has no moduli, or if they cannot be computed with the requested accuracy.
    InputError

    Notes
    -----
    docs/physics.md, "Elastic moduli" and "Bounds"; the columns ``*_printed`` follow the formulas as
    printed in [GRC2008].
    """
    states, single = states_of(state)
    several = rolling_stiffness is not None and np.ndim(rolling_stiffness) > 0
    rolling = [] if rolling_stiffness is None else list(np.atleast_1d(unmasked("rolling_stiffness", rolling_stiffness)))
    table, further = _core.moduli(
        states, strains=strains, prestress=prestress, tolerance=tolerance, method=method, accuracy=_accuracy(accuracy),
        force_tolerance=force_tolerance, rolling_stiffness=rolling, kn=kn, kt=kt, stiffness_per=stiffness_per,
        tables=tables, force=force)
    return records(Moduli, table, further, single and not several)


def network(state, *, zero_force=None, least_contacts=None, unit="mean", bin_width=0.1, groups=(), near_zero=0.02,
            shuffles=20, pressure_bin_width=0.1, without=(), tables=()):
    """Computes coordination, forces, particle pressures and the load-carrying structure, as ``floc network`` does.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    zero_force : float, optional
        Normal force below which a force counts as zero, in units of max(F0, P a^(d-1)) [the force tolerance of the
        state].
    least_contacts : int, optional
        A grain belongs to the force-carrying structure if it has at least this number of contacts whose force is not
        zero [2 if some contact carries a tangential force, otherwise d + 1].
    unit : {"mean", "F0", "P"}, bin_width : float
        Unit of force and width of the bins in the table "pdf" ("mean": the mean force).
    groups : sequence of {"bonds", "phases"}
        Groups of additional columns to compute.
    near_zero : float, shuffles : int, pressure_bin_width : float
        As the options ``--near-zero``, ``--shuffles`` and ``--pressure-bin-width`` of ``floc network``.
    without : sequence of {"mechanics"}
        Groups of columns that are set to None instead of being computed. "mechanics": the columns that need the
        moduli, which take most of the time for a large packing. For a state with walls, these columns are always None.
    tables : sequence of str
        Additional tables to compute: "pdf", "particle_stress", "exponents", "pressure_pdf", "like_neighbours",
        "clusters".

    Returns
    -------
    Network, or a list of them for a sequence of states
    """
    states, single = states_of(state)
    table, further = _core.network(
        states, zero_force=zero_force, least_contacts=least_contacts, unit=unit, bin_width=bin_width,
        groups=groups, near_zero=near_zero, shuffles=shuffles, pressure_bin_width=pressure_bin_width,
        without=without, tables=tables)
    return records(Network, table, further, single)


def structure(state, *, average=False, fit_range=(0.0, 1.0), largest_k=None, cells_per_wave=None, reach=5.0,
              map_size=(32, 32), probes=40, profile_axis=None, slices=20, tables=()):
    """Computes scattering, pores and local solid fractions of packings, as ``floc structure`` prints them.

    Parameters
    ----------
    state : State, path-like, or a sequence of them
    average : bool
        Whether to add a last row for all states together, which are then samples of one ensemble.
    fit_range : (float, float)
        Lowest and highest wave number of the fit, in units of 2 pi over the largest diameter.
    largest_k, cells_per_wave, reach, map_size, probes, profile_axis, slices
        As the options of these names of ``floc structure``.
    tables : sequence of str
        Additional tables to compute: "intensity", "pair_correlation", "gaps", "pores", "map", "prediction",
        "porosity", "profile".

    Returns
    -------
    Structure, or a list of them for a sequence of states

    Raises
    ------
    InputError
        If a state has walls, and a table other than "pair_correlation", "porosity" and "profile" is requested.
    """
    states, single = states_of(state)
    table, further = _core.structure(
        states, average=average, fit_range=fit_range, largest_k=largest_k, cells_per_wave=cells_per_wave,
        reach=reach, map_size=map_size, probes=probes, profile_axis=profile_axis, slices=slices,
        tables=tables)
    return records(Structure, table, further, single)


def compare(before, after, *, rigid_tolerance=0.01, tables=()):
    """Computes the changes between two states of the same grains, as ``floc compare`` prints them.

    Parameters
    ----------
    before, after : State or path-like
    rigid_tolerance : float
        Tolerance for contacts that move as a rigid body: largest distance between the two contact points after the
        change, in largest diameters, and largest difference of the rotations of the two grains, in radians.
    tables : sequence of str
        Additional tables to compute: "displacements" (one row per grain) and "contacts" (one row per contact: kept,
        lost or gained).

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        If the two states do not have the same grains.
    """
    (first,), _ = states_of(before)
    (second,), _ = states_of(after)
    table, further = _core.compare(first, second, rigid_tolerance=rigid_tolerance, tables=tables)
    return records(Comparison, table, further, True)


def forces(state, *, selection=None, friction=None, kn=None, kt=None, stress=(), gap=None, tables=(), ranges=False,
           range_of=()):
    """Finds contact forces at rest for the geometry of states, as ``floc forces`` prints them.

    Parameters
    ----------
    state : State, path-like, or sequence of these
    selection : {"closest", "canonical"}, optional
        "closest": the balanced forces closest to those of the state; "canonical": the balanced forces of least elastic
        energy ["closest" or, for a state without forces, "canonical"].
    friction : float, optional
        Friction coefficient of all contacts [the coefficient of the contact law].
    kn, kt : float, optional
        Stiffnesses K_N and K_T of all contacts in the elastic energy (force/length) [the stiffnesses of each contact].
    stress : float or sequence of float
        Stress that the forces transmit: the pressure, the components along the axes, or all components in the order
        of Voigt (force/length^(d-1)) [the stress that the forces of the state transmit].
    gap : float, optional
        Largest gap across which pairs of grains may carry a force, in units of the smallest diameter.
    tables : sequence of str
        Additional tables to compute: "contacts" (the force of each contact).
    ranges : bool
        Adds to the table "contacts", which has to be among `tables`, the smallest and the largest normal force that each
        contact can carry while all forces balance.
    range_of : sequence of int
        Adds the ranges of the contacts with these numbers alone, also without `ranges`.

    Returns
    -------
    Forces, or a list of these for a sequence of states

    Raises
    ------
    InputError
        If the contact law resists rolling or twisting, or the state has no forces and no stress is given.
    NumericalError
        If no set of forces balances the load.

    Notes
    -----
    docs/physics.md, "Forces at rest".
    """
    states, single = states_of(state)
    table, further = _core.forces(
        states, selection=selection, friction=friction, kn=kn, kt=kt, stress=[stress] if np.ndim(stress) == 0 else stress,
        gap=gap, tables=tables, ranges=ranges, range_of=range_of)
    return records(Forces, table, further, single)


def chain(n, R, kn, kt, kr, bend=0.0):
    """Computes compliances of a chain of equal disks, by closed form and by solution, as ``floc chain`` prints them.

    Parameters
    ----------
    n : int
        Number of disks, 2 to 1000000.
    R : float
        Radius of the disks (length).
    kn, kt, kr : float
        Stiffnesses K_N and K_T (force/length) and K_R (force length).
    bend : float
        Angle between successive branches (degrees); a bent chain has no closed form.

    Returns
    -------
    Chain
        The compliances axial, transverse, rolling and end_disk_deflection, each with formula, solved and error_bound:
        in length/force, and rolling in 1/(force length).

    Notes
    -----
    docs/physics.md, "Chains of disks"; end_disk_deflection is Eq. 16 of [GRC2008] as printed there.
    """
    names, rows = _core.chain(n, R, kn, kt, kr, bend)
    which = names.index("compliance")
    wanted = ("formula", "solved", "error_bound")
    compliances = {row[which]: Compliance(wanted, [row[names.index(name)] for name in wanted]) for row in rows}
    return Chain(compliances.keys(), compliances.values())


def _accuracy(accuracy):
    if accuracy is None:
        return []
    if isinstance(accuracy, dict):
        return [f"{name}={number('accuracy', error)!r}" for name, error in accuracy.items()]
    return [repr(number("accuracy", accuracy))]
