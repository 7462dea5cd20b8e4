"""Laws fitted to arrays or tables, as ``floc fit`` fits them.

Curves are given as arrays, as columns of a data frame, or as the name of a table or of a directory that ``floc run``
wrote, which is read as the command reads it. If the data do not allow a fit, there is no exception: the attribute
``refusal`` of the result has the reason.
"""
import collections.abc
import copy
import numbers
import os

import numpy as np

from . import _core
from ._errors import InputError
from ._records import ReadOnly, Record
from ._state import read, real_numbers

__all__ = ["Fit", "LoadPath", "Parameter", "compression", "consolidation", "cycle", "dynamic_compaction", "elastic",
           "force_distribution", "moduli", "preconsolidation", "read_table", "strength"]


class Parameter(Record):
    """A fitted parameter: value, stderr, low95, high95 and identified.

    low95 and high95 are the ends of the interval that contains the parameter with a probability of 95 %. If the data do
    not determine the parameter, its value is None, but a known bound is given.
    """

    @property
    def interval(self):
        """95 % confidence interval, (low95, high95)."""
        return self.low95, self.high95


class Fit(ReadOnly):
    """A fit. Its attributes are the entries that ``floc fit ... --format json`` prints.

    Attributes
    ----------
    parameters : dict of Parameter
        Parameters by name; ``fit["lambda"]`` is short for ``fit.parameters["lambda"]``.
    refusal : str or None
        Reason why there is no fit; None if there is one.
    warnings : list of str
        Warnings about the quality of the fit; not every law gives them.
    """

    def __init__(self, values):
        parameters = {name: Parameter(p.keys(), p.values()) for name, p in values["parameters"].items()}
        self.__dict__.update(_values=values, parameters=parameters)

    @property
    def found(self):
        """Whether there is a fit."""
        return self._values["refusal"] is None

    def __getattr__(self, name):
        values = self.__dict__.get("_values", {})
        if name in values:
            return values[name]
        raise AttributeError(f"this fit has no {name!r}; it has {', '.join(values)}")

    def __getitem__(self, parameter):
        return self.parameters[parameter]

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def to_dict(self):
        """Returns a dict of all entries, as the command prints them in json. It is a copy."""
        return copy.deepcopy(self._values)

    def __repr__(self):
        if not self.found:
            return f"<no fit: {self.refusal}>"
        lines = [f"  {name} = {p.value!r}, 95 % from {p.low95!r} to {p.high95!r}"
                 for name, p in self.parameters.items()]
        return "\n".join([f"Fit of {self.sample}:", *lines])


class LoadPath(ReadOnly):
    """A load path read from a table of measurements.

    Attributes
    ----------
    reading : str
        What was understood, in one line: rows, pressure and its unit, the quantity that stands for the solid fraction.
    notes : list of str
        Rows that do not count because the next one has the same pressure, and conversions.
    pressure, solid_fraction : array, (n,)
    branch : list of str
        Name of the branch of each row; empty names if the table has none.
    unit : str or None
        Unit of the pressures.
    name : str
        Name of the table.
    """

    def __init__(self, values):
        self.__dict__.update(values)

    def __len__(self):
        return len(self.pressure)

    def __repr__(self):
        return f"<{self.name}: {self.reading}>"


def read_table(table, *, columns=None, phi_limit=1.0):
    """Reads a load path from a table of measurements, as the commands read it.

    Parameters
    ----------
    table : path-like
    columns : dict, optional
        Names of the columns, as in `consolidation`.
    phi_limit : float or None
        Largest solid fraction that the rows may have; None for no bound, as in a die under load.

    Returns
    -------
    LoadPath
    """
    return LoadPath(_core.read_table(os.fspath(table), columns=_columns(columns), phi_limit=phi_limit))


def consolidation(pressure, solid_fraction=None, *, void_ratio=None, branch=None, law="auto", window=None, P0=None,
                  protocol=None, loading=None, weights=None, loss="squared", bootstrap=0, seed=1, stress=None,
                  phi_limit=1.0, columns=None):
    """Fits the consolidation law: the plasticity index lambda and its other parameters.

    Parameters
    ----------
    pressure : array_like, (n,), or a sequence of arrays, or path-like
        Reduced pressures P*; several arrays are several samples. Or the name of a table, or of a directory that
        ``floc run`` wrote.
    solid_fraction : array_like, (n,), or a sequence of arrays
        Solid fractions.
    void_ratio : array_like, optional
        Void ratios, instead of `solid_fraction`. This argument, `solid_fraction` and `branch` go with arrays only.
    branch : sequence of str, (n,), optional
        Name of the branch of the load path for each point, as in ``path.csv``; of several samples, one such sequence or
        None for each. By default, branches are found from the pressures.
    law : {"auto", "full", "log", "power"}
        "log": law of regime II; "power": law of regime III; "full": both; "auto": the one that the data support, which
        the attribute `law` of the result names.
    window : (float, float), optional
        Lowest and highest pressure to fit [found from the data].
    P0 : float, optional
        The fit begins at the pressure nearest to this one and ends at the last pressure [found from the data].
    protocol : {"published"}, optional
        Keeps P0* fixed at a pressure of the curve and fits the mean of the samples.
    loading : {"first", "virgin"}, optional
        "first": the first loading; "virgin": also later loadings where they exceed the largest earlier pressure
        ["virgin" with the law "auto", otherwise "first"].
    weights : {"uniform", "relative", "scatter"}, optional
    loss : {"squared", "huber", "cauchy"}
    bootstrap : int
        Number of resampled fits, from which additional errors are computed; 0 for none.
    seed : int
        Seed of the resampling.
    phi_limit : float or None
        Largest solid fraction to which a law may tend at high pressure, and that the samples may have; None for no bound, as
        for densities measured in a die under load.
    stress : {"driven", "mean"}, optional
        For tables only: the stress from which P* of an oedometric test is computed ["driven"].
    columns : dict, optional
        For tables only: the names of the columns for the keys P_star, phi, void_ratio or another density, branch, with
        a unit if the table has none, as in ``{"void_ratio": "e [%]"}``; or numbers, as in
        ``{"initial_void_ratio": 0.8}``. Columns with usual names are found without this argument.

    Returns
    -------
    Fit, or for several samples a list of fits, the last of which is the fit of their mean
        Parameters lambda, P0_star, Phi0, alpha, P1_star, Phi_max, if the law has them; with the law "auto" also kappa,
        and the indices C_c and C_s, which are ln(10) lambda and ln(10) kappa.

    Raises
    ------
    InputError
        If the arrays are not a valid curve; the message names the array, the index and the value.

    Notes
    -----
    1/Phi = 1/Phi0 - lambda ln(P*/P0*) in regime II, 1/Phi = 1/Phi_max + A (P*)^-alpha in regime III [GRC2008].
    """
    fits = _core.fit_consolidation(
        _samples(pressure, solid_fraction, void_ratio, branch, columns=columns, stress=stress), columns=_columns(columns),
        law=law, window=window, P0=P0, protocol=protocol or "", loading=loading or "", weights=weights or "", loss=loss,
        bootstrap=bootstrap, seed=seed, stress="driven" if stress is None else stress, phi_limit=phi_limit)
    return Fit(fits[0]) if len(fits) == 1 else [Fit(fit) for fit in fits]


def compression(pressure, solid_fraction=None, *, void_ratio=None, branch=None, law="all", density="out-of-die", D0=None,
                phi_limit=1.0, columns=None):
    """Fits the laws of powder compression to first loadings, and ranks them by Akaike's criterion.

    Parameters
    ----------
    pressure, solid_fraction, void_ratio, branch
        As in `consolidation`; the pressures are P.
    law : {"all", "heckel", "kawakita", "cooper-eaton", "walker", "gurnham", "adams"}
    density : {"out-of-die", "in-die"}
        "in-die": measured under load, where elastic strain may take the solid fraction beyond 1.
    D0 : float, optional
        Solid fraction of the powder without pressure [fitted].
    phi_limit : float or None
        Largest solid fraction to which a law may tend at high pressure, and that the samples may have; None for no bound, as
        for densities measured in a die under load.
    columns : dict
        For tables only: the names of the columns for the keys P, P_star, phi, void_ratio, branch.

    Returns
    -------
    list of Fit
        One for each sample and law; the fits of a sample are in the order of their rank. They have the attributes law,
        delta_aicc, akaike_weight, residual_pattern and window.

    Raises
    ------
    InputError
        If the arrays are not a valid curve; the message names the array, the index and the value.
    """
    samples = _samples(pressure, solid_fraction, void_ratio, branch, columns=columns)
    return [Fit(fit) for fit in _core.fit_compression(samples, columns=_columns(columns), law=law, density=density, D0=D0,
                                                      phi_limit=phi_limit)]


def preconsolidation(pressure, solid_fraction=None, *, void_ratio=None, branch=None, branches=None, phi_limit=1.0,
                     columns=None):
    """Determines the preconsolidation pressure of overconsolidated samples from reloading branches or a first loading.

    Parameters
    ----------
    pressure, solid_fraction, void_ratio, branch, columns
        As in `consolidation`.
    branches : {"reloading", "first", "all"}, optional
        Branches to fit; "first" is the first loading [reloading branches or, if there are none, the first loading].
    phi_limit : float or None
        Largest solid fraction that the samples may have; None for no bound, as in a die under load.

    Returns
    -------
    list of Fit
        One per branch. Parameters P_c (two lines with a round bend), kappa and lambda and, with eight pressures or more,
        P_c_casagrande, P_c_pacheco_silva, P_c_butterfield, P_c_becker, and P_c_agreed, where all of these agree.
    """
    samples = _samples(pressure, solid_fraction, void_ratio, branch, columns=columns)
    return [Fit(fit) for fit in _core.fit_preconsolidation(samples, columns=_columns(columns), branches=branches or "",
                                                           phi_limit=phi_limit)]


def elastic(pressure, solid_fraction=None, *, void_ratio=None, branch=None, state=None, phi_limit=1.0, columns=None):
    """Fits elastic moduli to unloading branches, by ln Phi = ln Phi_unloaded + P/B.

    In an oedometer, B is the modulus for the mean stress and M the modulus for the driven stress.

    Parameters
    ----------
    pressure, solid_fraction, void_ratio, branch, columns
        As in `consolidation`; the pressures are P.
    state : path-like, optional
        State file. The modulus of this state, computed from its contact network, is given in addition to the fit [for
        tables, the state at the start of the branch, if its file is in the directory of the table].
    phi_limit : float or None
        Largest solid fraction that the samples may have; None for no bound, as in a die under load.

    Returns
    -------
    list of Fit
        One per unloading branch.
    """
    samples = _samples(pressure, solid_fraction, void_ratio, branch, columns=columns)
    fits = _core.fit_elastic(samples, columns=_columns(columns), state="" if state is None else os.fspath(state),
                             phi_limit=phi_limit)
    return [Fit(fit) for fit in fits]


def cycle(pressure, solid_fraction=None, *, void_ratio=None, branch=None, phi_limit=1.0, columns=None):
    """Computes the permanent changes of Phi after pressure cycles, and the work of the cycles.

    Parameters
    ----------
    pressure, solid_fraction, void_ratio, branch, columns
        As in `consolidation`; the pressures are P.
    phi_limit : float or None
        Largest solid fraction that the samples may have; None for no bound, as in a die under load.

    Returns
    -------
    dict of arrays
        The columns of ``floc fit cycle``, one row per pressure of a cycle.
    """
    samples = _samples(pressure, solid_fraction, void_ratio, branch, columns=columns)
    return _core.fit_cycle(samples, columns=_columns(columns), phi_limit=phi_limit)


def moduli(tables, *, moduli=None, branch="first", phi_limit=1.0, columns=None):
    """Fits power laws of elastic moduli against the pressure and against the solid fraction.

    Parameters
    ----------
    tables : path-like or sequence of them
        Tables of ``floc moduli``, or other tables with a pressure and moduli.
    moduli : str or sequence of str, optional
        Columns of the moduli [those of B, B_S, G, G_shear, M and E of which the table has values].
    branch : {"first", "all"}
        States to fit: those of the first loading of each sample, or all.
    phi_limit : float or None
        Largest solid fraction that the samples may have; None for no bound, as in a die under load.
    columns : dict, optional
        Names of the columns of the keys P, P_star, phi or another density, B, G and other moduli.

    Returns
    -------
    list of Fit
        One per sample, modulus and quantity, with the attributes modulus and against ("P" or "phi"); for several samples
        also their means. Parameters exponent, coefficient and, against the solid fraction, phi_0.

    Notes
    -----
    M = coefficient P^exponent, and M = coefficient (Phi - phi_0)^exponent.
    """
    return [Fit(fit) for fit in _core.fit_moduli(_names(tables), columns=_columns(columns), moduli=moduli, branch=branch,
                                                 phi_limit=phi_limit)]


def strength(tables, *, kind="drained", critical_from=None, modulus=None, columns=None):
    """Evaluates mechanical tests as a laboratory reports them.

    Parameters
    ----------
    tables : path-like or sequence of them
        Directories that ``floc run`` wrote, or of campaigns, or tables of a test.
    kind : {"drained", "undrained", "oedometer", "simple-shear"}
        Kind of the test in tables that ``floc run`` has not written.
    critical_from : float, optional
        Strain from which on a sample is in its critical state [the last quarter of the strain].
    modulus : (float, float), optional
        Axial stresses between which the constrained modulus is taken [half of the largest one to the largest].
    columns : dict, optional
        Names of the columns of the keys sigma1, sigma3, strain, volumetric_strain, or sigma_n, tau, shear_strain.

    Returns
    -------
    list of Fit
        One per test, then one for all tests of each kind together, with the attribute test.
    """
    return [Fit(fit) for fit in _core.fit_strength(_names(tables), columns=_columns(columns), kind=kind,
                                                   critical_from=critical_from, modulus=modulus)]


def dynamic_compaction(e, p, sc, se, *, p_D=None, eta_m=None, plateau="p", p_0=None):
    """Fits the void ratio of dynamically compacted samples as a function of pressure and cohesion.

    Parameters
    ----------
    e, p, sc, se : array_like, (n,)
        Void ratio, pressure, f_c/d^2 (cohesive force f_c, diameter d) and k_n/d (normal stiffness k_n) of each sample;
        the last three in equal units.
    p_D : float, optional
        Pressure at which the plateau is e_min + De [0.01].
    eta_m : float, optional
        Reduced cohesion eta* at which (1 - e_r)/e_r = s_m [0.045].
    plateau : {"p", "p_crit"}
        Pressure at which the plateau is evaluated.
    p_0 : float, optional
        Smallest pressure at which the plateau is fitted.

    Returns
    -------
    Fit

    Notes
    -----
    [SVI2024], Eqs 13-17 and 29-31.
    """
    arrays = [_flat(name, values) for name, values in (("e", e), ("p", p), ("sc", sc), ("se", se))]
    return Fit(_core.fit_dynamic_compaction(*arrays, p_D=p_D, eta_m=eta_m, plateau=plateau, p_0=p_0))


def force_distribution(forces, *, form="all", threshold=None, draws=None, seed=None):
    """Fits distributions of normal forces by maximum likelihood, with the goodness of the fit.

    Parameters
    ----------
    forces : array_like, (n,), or State or path-like
        Normal forces, positive in compression, or a state whose contact forces are used.
    form : {"all", "tails", "power-exponential", "quadratic-exponential"}
    threshold : float, optional
        Magnitude of the force at which the tails begin [the mean of the forces of each sign].
    draws : int, optional
        Number of random samples of the fitted law, from which the p-value is computed [200].
    seed : int, optional
        Seed of these random samples [1].

    Returns
    -------
    list of Fit
        One fit per form of the distribution.
    """
    if isinstance(forces, (str, os.PathLike)):
        forces = read(forces)
    name = "arrays"
    if isinstance(forces, _core.State):
        name, forces = forces.name, forces.contacts["normal_force"]
    fits = _core.fit_force_distribution(name, _flat("forces", forces), form=form, threshold=threshold, draws=draws,
                                        seed=seed)
    return [Fit(fit) for fit in fits]


def _names(tables):
    """Returns names of files, given as one or several."""
    try:
        return [os.fspath(table) for table in ([tables] if isinstance(tables, (str, os.PathLike)) else tables)]
    except TypeError:
        raise InputError(f"tables = {tables!r}: expected the path of a table or a sequence of paths") from None


def _columns(columns):
    """Returns the names of columns for the compiled module: texts, with a number such as an initial void ratio as one."""
    if columns is None:
        return {}
    if not isinstance(columns, collections.abc.Mapping):
        raise InputError(f"columns = {columns!r}: expected a dict of quantities and the names of their columns")
    named = {}
    for quantity, name in columns.items():
        if isinstance(name, numbers.Real) and not isinstance(name, bool):
            name = repr(int(name) if isinstance(name, numbers.Integral) else float(name))
        if not isinstance(quantity, str) or not isinstance(name, str):
            raise InputError(f"columns: {quantity!r} = {name!r}: expected the name of a quantity, and that of its column "
                             "or a number")
        named[quantity] = name
    return named


def _flat(name, values):
    array = real_numbers(name, values)
    if array.ndim != 1:
        raise InputError(f"{name}: this array has shape {array.shape}, expected (n,)")
    if not np.isfinite(array).all():
        at = int(np.flatnonzero(~np.isfinite(array))[0])
        raise InputError(f"{name}[{at}]: this number is {array[at]}, expected a finite number")
    return array


def _samples(pressure, solid_fraction, void_ratio, branch, **for_tables):
    """Returns the samples for the compiled module: a file name, or one tuple (name, pressures, densities, whether the
    densities are void ratios, branches) per sample.

    `for_tables` are arguments that only tables take. Arguments that the first one makes useless are refused.
    """
    arrays = {"solid_fraction": solid_fraction, "void_ratio": void_ratio, "branch": branch}
    if isinstance(pressure, (str, os.PathLike)):
        for name, given in arrays.items():
            if given is not None:
                raise InputError(f"{name}: this argument is for arrays, but pressure is the path of a table: leave it out")
        return [os.fspath(pressure)]
    for name, given in for_tables.items():
        if given:
            raise InputError(f"{name}: this argument is for tables, but pressure is an array: leave it out")
    if (solid_fraction is None) == (void_ratio is None):
        raise InputError("expected either solid_fraction or void_ratio, in addition to pressure")
    density = solid_fraction if void_ratio is None else void_ratio
    what = "solid_fraction" if void_ratio is None else "void_ratio"
    if not isinstance(pressure, (list, tuple)) or len(pressure) == 0 or np.ndim(pressure[0]) == 0:
        return [_sample("arrays", pressure, density, branch, what)]
    n = len(pressure)
    densities = _one_per_sample(what, density, n)
    branches = [None] * n if branch is None else _one_per_sample("branch", branch, n)
    return [_sample(f"arrays {k}", *one, what) for k, one in enumerate(zip(pressure, densities, branches))]


def _one_per_sample(name, values, n):
    """Returns the items of an argument that has one array or list for each of `n` samples."""
    try:
        items = None if isinstance(values, str) else list(values)
    except TypeError:
        items = None
    if items is None:
        raise InputError(f"{name} = {values!r}: expected one array for each of the {n} samples in pressure")
    if len(items) != n:
        raise InputError(f"{name}: this argument has {len(items)} samples, but pressure has {n}")
    return items


def _sample(name, pressure, density, branch, what):
    pressure, density = _flat("pressure", pressure), _flat(what, density)
    if density.shape != pressure.shape:
        raise InputError(f"{what}: this array has shape {density.shape}, expected the shape of pressure, "
                         f"{pressure.shape}")
    if branch is None:
        return name, pressure, density, what == "void_ratio", []
    if isinstance(branch, str) or not isinstance(branch, collections.abc.Iterable):
        raise InputError(f"branch = {branch!r}: expected a sequence of names, one per pressure")
    branches = [str(one) for one in branch]
    if len(branches) != len(pressure):
        raise InputError(f"branch: this argument has {len(branches)} names, expected one per pressure, {len(pressure)}")
    return name, pressure, density, what == "void_ratio", branches
