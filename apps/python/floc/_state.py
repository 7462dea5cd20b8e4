"""States and packings."""
import os
import pathlib
import tempfile

import numpy as np

from . import _core
from ._errors import InputError


def _documented(name, words):
    return property(getattr(_core.State, name).fget, doc=words)


class State(_core.State):
    """One packing with its contacts, as a state file holds it. It cannot be changed.

    Arrays are views of the memory of the state: they cost nothing, cannot be written to, and keep the state alive
    for as long as they are there. Lengths, forces and masses are in the units of the state (``units``). Forces and
    stresses are positive in compression. In what follows n is the number of grains, d the dimension.
    """

    position = _documented("position", "(n, d) centres of the grains, inside the cell (length).")
    position_low = _documented("position_low", "(n, d) offsets of the centres from ``position``, less than half a unit "
                               "in its last place (length); None where there are none.")
    velocity = _documented("velocity", "(n, d) velocities without the affine part of the cell (length/time).")
    radius = _documented("radius", "(n,) radii (length).")
    ids = _documented("ids", "(n,) numbers by which messages and tables name the grains: those of the program a packing came "
                      "from, otherwise the indices. ``contacts`` refers to indices.")
    mass = _documented("mass", "(n,) masses.")
    orientation = _documented("orientation", "(n,) angles in radians; in 3D (n, 4) quaternions x, y, z, w, as SciPy "
                              "orders them.")
    angular_velocity = _documented("angular_velocity", "(n,) or, in 3D, (n, 3) angular velocities (1/time).")
    contacts = _documented("contacts", "Contacts as a structured array, with the names of a state file: id1, id2 (index of the "
                           "grains; id2 >= n is wall id2 - n), image (branch = position[id2] + image @ cell - position[id1]), key, "
                           "gap (negative: overlap), normal (from id1 to id2), normal_force, elastic_force, shear_force and "
                           "rolling_moment (on id1), twisting_moment, kn, kt, kr, ktw, sliding, rolling_yield, twisting_yield, "
                           "distant (acts across a gap), and what contacts remember under the law. "
                           "``contacts[\"normal_force\"]`` is one column, a view too.")
    cell = _documented("cell", "(d, d) lattice vectors, one a row (length). Between walls, the sides of the box.")
    stress = _documented("stress", "(d, d) static stress of the contacts when the state was saved (force/length^(d-1)).")
    target_stress = _documented("target_stress", "(d,) diagonal stress imposed; what the contacts carried on an axis with a "
                                "length imposed (force/length^(d-1)).")
    dimension = _documented("dimension", "2 or 3.")
    n_grains = _documented("n_grains", "Number of grains.")
    n_contacts = _documented("n_contacts", "Number of interactions, distant ones included.")
    pressure = _documented("pressure", "Mean of the diagonal of the static stress, the column P of ``floc moduli`` "
                           "(force/length^(d-1)).")
    reduced_pressure = _documented("reduced_pressure", "P*: pressure in units of the contact law, a^(d-1) P/F0; without "
                                   "adhesion a^(d-2) P/K_N, of elastic spheres P/E~.")
    solid_fraction = _documented("solid_fraction", "Area (3D: volume) of the grains over that of the cell.")
    residuals = _documented("residuals", "Distance from equilibrium: force, moment, stress and energy, in units of "
                            "F1 = max(F0, P a^(d-1)) and a (docs/physics.md, \"Equilibrium\").")
    tolerance = _documented("tolerance", "What the residuals were asked to be below.")
    equilibrium_faults = _documented("equilibrium_faults", "By how much the state misses its equilibrium, in words; empty "
                                     "if it is one.")
    name = _documented("name", "The file it was read from; what messages call it.")
    units = _documented("units", '"reduced" or "SI".')
    law = _documented("law", "The contact law in one line, as ``floc convert --law`` and ``Packing.from_arrays`` take it.")
    walls = _documented("walls", "Walls of a box: dicts of axis, side, position, velocity, mass; empty in a periodic cell.")
    path = _documented("path", "Where the state stands on its load path: step, branch, time, n_steps, ending.")
    scene = _documented("scene", "Text of the scene, empty for a packing of another program.")
    provenance = _documented("provenance", "Origin of the state: program, commit, compiler, seed, parent_sha256, source.")

    @property
    def void_ratio(self):
        """1/solid_fraction - 1."""
        return 1.0 / self.solid_fraction - 1.0

    def write(self, path):
        """Writes a state file, whole or not at all.

        Parameters
        ----------
        path : path-like

        Raises
        ------
        FileError
            If it cannot be written.
        """
        super().write(os.fspath(path))

    # Nothing can change a state, so that copies may share its memory.
    def __copy__(self):
        return type(self)(self)

    def __deepcopy__(self, memo):
        return type(self)(self)

    def __reduce__(self):
        with tempfile.TemporaryDirectory(prefix="floc-") as directory:
            path = pathlib.Path(directory) / "state.h5"
            self.write(path)
            return _restored, (type(self), self.name, path.read_bytes())

    def __repr__(self):
        return (f"<{type(self).__name__} {self.name!r}: {self.n_grains} grains in {self.dimension}D, "
                f"{self.n_contacts} contacts, phi = {self.solid_fraction:.6g}, P = {self.pressure:.6g}>")


class Packing(State):
    """A packing put together from arrays."""

    @classmethod
    def from_arrays(cls, position, radius, cell, law, contacts=None, *, mass=None, stress=None, tolerance=None,
                    units="reduced", drop_tensile=False, ids=None):
        """Makes a packing from arrays of any program, for moduli and all else, as ``floc convert`` makes one from files.

        What contacts do not say follows from the law: forces that are given are kept to the last digit, and springs are
        stretched to them. Without `contacts`, the pairs that interact by the law are taken.

        Parameters
        ----------
        position : array_like, (n, d)
            Centres, inside the cell or not (length).
        radius : array_like, (n,)
            Radii (length).
        cell : array_like, (d, d) or (d,)
            Lattice vectors of the periodic cell, one a row, or the sides of a right-angled one (length). d is 2 or 3.
        law : str or dict
            Contact law by the keys of a scene below ``contact``:
            ``{"normal.stiffness": 1e5, "friction": {"coefficient": 0.5, "stiffness": 1e5}}`` or in one line,
            ``"normal.stiffness=1e5, friction.coefficient=0.5, friction.stiffness=1e5"``.
        contacts : dict of arrays, structured array or DataFrame, optional
            id1 and id2, the two grains by their `ids`, without these by their indices from 0, and of what is known: image
            (m, d), normal_force (m,), positive in compression, shear_force (m, d) on id1, or force (m, d), all of the force on id1; rolling_moment (m,) or, in
            3D, (m, 3), twisting_moment (m,), kn, kt, kr, ktw (m,), bridge_volume (m,) of a law with liquid.
        mass : array_like, (n,), optional
            Masses; without them unit mass at unit diameter.
        stress : array_like, (d,), optional
            Diagonal stress imposed, positive in compression; without it, what the contacts carry.
        tolerance : float, optional
            How far from equilibrium the packing may be: net force over F1, net moment over F1 a, stress over
            F1/a^(d-1). 1e-3 unless it is given.
        units : {"reduced", "SI"}
        drop_tensile : bool
            Leaves out contacts that pull under a law without adhesion, which are an error otherwise.
        ids : array_like of int, (n,), optional
            Numbers by which contacts, messages and tables name the grains; without them their indices.

        Returns
        -------
        Packing

        Raises
        ------
        InputError
            If the arrays are not a packing; the message names the array, the index, the value and what was expected.

        Warns
        -----
        FlocWarning
            Where list, geometry, forces, law and equilibrium disagree.
        """
        cell = _numbers("cell", cell)
        if cell.ndim == 1:
            cell = np.diag(cell)
        return cls(_core.from_arrays(
            position=_numbers("position", position), radius=_numbers("radius", radius), cell=cell, law=_law_text(law),
            contacts=_contact_arrays(contacts), mass=None if mass is None else _numbers("mass", mass),
            stress=[] if stress is None else unmasked("stress", stress), tolerance=tolerance, units=units,
            drop_tensile=drop_tensile, ids=None if ids is None else _integers("ids", np.asarray(unmasked("ids", ids)))))


def read(path):
    """Reads a state file.

    Parameters
    ----------
    path : path-like
        A file that ``floc run`` or ``floc convert`` wrote.

    Returns
    -------
    State

    Raises
    ------
    InputError
        If the file is missing, damaged, of another version, or not a state; the message names the dataset.
    """
    return State(_core.read(os.fspath(path)))


def _restored(cls, name, content):
    """The state of a pickle: a state file, and the name that the state had."""
    with tempfile.TemporaryDirectory(prefix="floc-") as directory:
        path = pathlib.Path(directory) / "state.h5"
        path.write_bytes(content)
        return cls(_core.restore(os.fspath(path), name))


def states_of(state):
    """(list of states, whether it is that of one) of a state, a path, or several of them."""
    if isinstance(state, (_core.State, str, os.PathLike)):
        return [_one(state)], True
    return [_one(one) for one in state], False


def _one(state):
    if isinstance(state, _core.State):
        return state
    if isinstance(state, (str, os.PathLike)):
        return read(state)
    raise TypeError(f"expected a State, the path of a state file, or several of these, not {type(state).__name__}")


def unmasked(name, values):
    """The values, of which none may be masked: a mask says that a value is none, and there is nothing in its place."""
    parts = [((k,), one) for k, one in enumerate(values)] if isinstance(values, (list, tuple)) else [((), values)]
    for at, part in parts:
        if isinstance(part, np.ma.MaskedArray) and np.ma.getmaskarray(part).any():
            at += tuple(int(i) for i in np.argwhere(np.ma.getmaskarray(part))[0])
            raise InputError(f"{name}[{', '.join(map(str, at))}]: is masked, expected a value: leave masked entries out")
    return values


def number(name, value):
    """A float of what is one, however Python has it."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} = {value!r}: expected a number") from None


def _numbers(name, values):
    values = unmasked(name, values)
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: expected an array of numbers: {error}") from None


# What a list of contacts may say; a structured array or data frame may have more.
_CONTACT_NUMBERS = ("image", "force", "normal_force", "shear_force", "rolling_moment", "twisting_moment", "kn", "kt", "kr",
                    "ktw", "bridge_volume")
# The contacts of a state have zeros of these where the law knows no such thing.
_MOMENTS = ("rolling_moment", "twisting_moment")


def _integers(name, array):
    """Integers, also where they are written as real numbers, as in a table of numpy.loadtxt."""
    if np.issubdtype(array.dtype, np.integer):
        return array
    whole = np.issubdtype(array.dtype, np.floating) and (np.abs(array) <= 2.0**53) & (array == np.floor(array))
    if not np.all(whole):
        raise InputError(f"{name} has values of type {array.dtype}, expected integers")
    return array.astype(np.int64)


def _contact_arrays(contacts):
    if contacts is None:
        return None
    try:
        names = contacts.dtype.names if isinstance(contacts, np.ndarray) else list(contacts)
    except TypeError:
        names = None
    if names is None:
        raise InputError("contacts: expected a dict of arrays, a structured array or a data frame")
    known = ("id1", "id2", *_CONTACT_NUMBERS)
    if isinstance(contacts, dict) and not set(names) <= set(known):
        raise InputError(f"contacts: {sorted(set(names) - set(known))[0]!r} is not one of {', '.join(known)}")
    arrays = {}
    for name in known:
        if name not in names:
            continue
        array = np.asarray(unmasked(f"contacts: {name}", contacts[name]))
        if name in _MOMENTS and isinstance(contacts, np.ndarray) and not array.any():
            continue
        arrays[name] = (_integers if name in ("id1", "id2", "image") else _numbers)(f"contacts: {name}", array)
    return arrays


def _law_text(law):
    if isinstance(law, str):
        return law
    if not isinstance(law, dict):
        raise InputError(f"law = {law!r}: expected a dict or a string of keys, as Packing.from_arrays has them")
    parts = []

    def add(prefix, table):
        for key, value in table.items():
            if isinstance(value, dict):
                add(f"{prefix}{key}.", value)
            else:
                text = value if isinstance(value, str) else repr(number(f"law: {prefix}{key}", value))
                parts.append(f"{prefix}{key}={text}")

    add("", law)
    return ", ".join(parts)
