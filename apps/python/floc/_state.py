"""States and packings."""
import collections.abc
import operator
import os
import pathlib
import tempfile

import numpy as np

from . import _core
from ._errors import InputError


def _documented(name, words):
    return property(getattr(_core.State, name).fget, doc=words)


class State(_core.State):
    """A packing with its contacts, with the content of a state file. It cannot be changed.

    Arrays are views of the memory of the state: they are not copies, cannot be written to, and keep the state alive
    as long as they exist. Lengths, forces and masses are in the units of the state (``units``). Forces and
    stresses are positive in compression. Below, n is the number of grains and d the dimension.
    """

    position = _documented("position", "(n, d) centres of the grains, inside the cell (length).")
    position_low = _documented("position_low", "(n, d) further digits of the centres, to be added to ``position`` "
                                               "(length); less than half a unit of its last digit. None if the state "
                                               "has none.")
    velocity = _documented("velocity", "(n, d) velocities of the grains without the affine motion of the cell "
                                       "(length/time).")
    radius = _documented("radius", "(n,) radii of the grains (length).")
    ids = _documented("ids", "(n,) identifiers of the grains in messages and tables: those of the program that made "
                             "the packing, otherwise the indices. ``contacts`` refers to indices.")
    mass = _documented("mass", "(n,) masses of the grains (mass).")
    orientation = _documented("orientation", "(n,) angles (radians); in 3D (n, 4) quaternions in the order x, y, z, "
                                             "w of SciPy.")
    angular_velocity = _documented("angular_velocity", "(n,) or, in 3D, (n, 3) angular velocities (1/time).")
    contacts = _documented("contacts", 'Contacts as a structured array, with the names of a state file: id1, id2 '
                                       '(indices of the two grains; id2 >= n is wall id2 - n), image (branch = '
                                       'position[id2] + image @ cell - position[id1]), key, gap (negative: overlap), '
                                       'normal (from id1 to id2), normal_force, elastic_force, shear_force and '
                                       'rolling_moment (on id1), twisting_moment, stiffnesses kn, kt, kr, ktw, '
                                       'sliding, rolling_yield, twisting_yield, distant (acts across a gap); of grains '
                                       'with corners point (from the centre of id1 to the contact point) and type (0 '
                                       'vertex and face, 1 two edges, 2 edge and face, 3 two faces); and the history '
                                       'that the law defines. ``contacts["normal_force"]`` is one of these '
                                       'fields, also a view.')
    cell = _documented("cell", "(d, d) lattice vectors, one per row (length). Between walls, the sides of the box.")
    stress = _documented("stress", "(d, d) static stress of the contacts when the state was saved "
                                   "(force/length^(d-1)).")
    target_stress = _documented("target_stress", "(d,) imposed normal stresses; on an axis with imposed length, the "
                                                 "stress of the contacts (force/length^(d-1)).")
    dimension = _documented("dimension", "2 or 3.")
    n_grains = _documented("n_grains", "Number of grains.")
    n_contacts = _documented("n_contacts", "Number of interactions, including distant ones (across a gap).")
    pressure = _documented("pressure", "Mean of the diagonal of the static stress; the column P of ``floc moduli`` "
                                       "(force/length^(d-1)).")
    reduced_pressure = _documented("reduced_pressure", "P*, the pressure in units of the contact law: a^(d-1) P/F0; "
                                                       "without adhesion a^(d-2) P/K_N; for elastic spheres P/E~.")
    solid_fraction = _documented("solid_fraction", "Area (3D: volume) of the grains divided by that of the cell.")
    residuals = _documented("residuals", 'Distance from equilibrium: force, moment, stress and energy, in units of '
                                         'F1 = max(F0, P a^(d-1)) and a (docs/physics.md, "Equilibrium").')
    tolerance = _documented("tolerance", "Largest residuals that count as equilibrium, as imposed in the run.")
    equilibrium_faults = _documented("equilibrium_faults", "Text with the residuals that exceed their tolerance; "
                                                           "empty if the state is in equilibrium.")
    name = _documented("name", "Name of the state in messages: the file from which it was read.")
    units = _documented("units", "\"reduced\" or \"SI\".")
    law = _documented("law", "The contact law in one line, as ``floc convert --law`` and ``Packing.from_arrays`` "
                             "read it.")
    walls = _documented("walls", "Ends of the axes that are not periodic: dicts of axis, side, position, velocity, mass, "
                                 "open (no wall, but free space); empty in a periodic cell.")
    path = _documented("path", "Position of the state on its load path: step, branch, time, n_steps, ending.")
    shapes = _documented("shapes", "Shapes of grains with corners, a list of dicts: vertices (k, d) about the centre of mass "
                                   "and faces (arrays of indices of vertices, counter-clockwise from outside; in 2D sides) "
                                   "of the core, rounding (radius of the ball that is added to it), volume, inertia for "
                                   "density 1, outer_radius. None for disks and spheres.")
    shape = _documented("shape", "(n,) indices of the grains' shapes in ``shapes``; None for disks and spheres.")
    scale = _documented("scale", "(n,) factors by which the shapes are magnified; None for disks and spheres.")
    motion = _documented("motion", "For rigid grains in motion: the time step that begins at the state, with time_step, residual "
                                   "(error of the impulses divided by the mean impulse) and inertial_number. None at rest.")
    scene = _documented("scene", "Text of the scene; empty for a packing of another program.")
    provenance = _documented("provenance", "Origin of the state: program, commit, compiler, seed, parent_sha256, "
                                           "source.")

    @property
    def void_ratio(self):
        """Void ratio, 1/solid_fraction - 1."""
        return 1.0 / self.solid_fraction - 1.0

    def vertices(self, grain):
        """Vertices of a grain with corners in space, about its position inside the cell.

        Parameters
        ----------
        grain : int
            Index of the grain.

        Returns
        -------
        ndarray, (k, d)
            Vertices of its core (length), in the order of ``shapes``; none for a disk or sphere.

        Raises
        ------
        InputError
            If there is no grain of this index.
        """
        grain = _index("grain", grain, self.n_grains)
        if self.shapes is None:
            return np.zeros((0, self.dimension))
        local = self.scale[grain] * self.shapes[self.shape[grain]]["vertices"]
        if self.dimension == 2:
            c, s = np.cos(self.orientation[grain]), np.sin(self.orientation[grain])
            turn = np.array([[c, -s], [s, c]])
        else:
            v, w = self.orientation[grain][:3], self.orientation[grain][3]
            skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
            turn = np.eye(3) + 2 * w * skew + 2 * skew @ skew
        return self.position[grain] + local @ turn.T

    def write(self, path):
        """Writes a state file. If this fails, no incomplete file remains.

        Parameters
        ----------
        path : path-like

        Raises
        ------
        FileError
            If the file cannot be written.
        """
        super().write(os.fspath(path))

    # A state never changes, so copies can share its memory.
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
    """A packing made from arrays."""

    @classmethod
    def from_arrays(cls, position, radius, cell, law, contacts=None, *, mass=None, stress=None, tolerance=None,
                    units="reduced", drop_tensile=False, ids=None, walls="", wall_law=None, gravity=None, bonds=None,
                    shapes=None, shape=None, scale=None, orientation=None, touch_gap=None, wall_ids=None):
        """Makes a packing from arrays of any program, as ``floc convert`` makes a packing from files.

        Quantities that `contacts` does not give follow from the contact law. Forces that are given are kept to the last
        digit, and the springs of the contacts are stretched accordingly. Without `contacts`, the contacts are the pairs
        that interact under the law.

        Parameters
        ----------
        position : array_like, (n, d)
            Centres of the grains, inside or outside the cell (length); of grains with `shapes`, the places of the origin of
            the vertices.
        radius : array_like, (n,)
            Radii of the grains (length); None with `shapes`.
        cell : array_like, (d, d) or (d,)
            Lattice vectors of the periodic cell, one per row, or the sides of a rectangular cell (length). d is 2 or 3.
        law : str or dict
            Contact law, given by the keys of a scene below ``contact``:
            ``{"normal.stiffness": 1e5, "friction": {"coefficient": 0.5, "stiffness": 1e5}}`` or in one line,
            ``"normal.stiffness=1e5, friction.coefficient=0.5, friction.stiffness=1e5"``.
        contacts : dict of arrays, structured array or DataFrame, optional
            id1 and id2: the `ids` of the two grains or, without `ids`, their indices from 0. Optional are image (m, d);
            normal_force (m,), positive in compression, and shear_force (m, d) on id1, or instead force (m, d), the
            whole force on id1 (beside shear_force its normal part alone); rolling_moment (m,), in 3D (m, 3); twisting_moment (m,); kn, kt, kr, ktw (m,); and
            bridge_volume (m,) for a law with liquid. Contacts of `shapes` need point (m, d), from the centre of mass of id1
            to the contact point, and may have normal (m, d), from id1 to id2, gap (m,) and type (m,), as ``contacts`` of
            a state has them. m is the number of contacts. Where `walls` are given, wall (m,)
            holds the names of walls, "x-" or "y+", that id1 touches, and empty texts for contacts of two grains. If there
            is no contact of a disk or sphere with a wall, these contacts are found, with the forces of the law.
        mass : array_like, (n,), optional
            Masses of the grains; by default, a disk or sphere with unit diameter has unit mass, and `shapes` its
            density.
        stress : array_like, (d,), optional
            Imposed normal stresses, positive in compression; by default, the stresses of the contacts.
        tolerance : float, optional
            Largest residuals in equilibrium: net force in units of F1, net moment in units of F1 a, error of the
            stress in units of F1/a^(d-1), with F1 = max(F0, P a^(d-1)) [1e-3].
        units : {"reduced", "SI"}
        drop_tensile : bool
            Whether to leave out tensile contacts under a law without adhesion, which otherwise are an error.
        ids : array_like of int, (n,), optional
            Identifiers of the grains in contacts, messages and tables; by default their indices.
        walls : str
            Axes that are not periodic, as for ``floc convert --walls``: "x,y" puts walls at both faces of the box,
            "y=0:5" at these places, "y=0:" a floor at 0 with free space above [all axes are periodic].
        wall_law : str or dict, optional
            Contact law between grains and walls, given as `law`; by default that between grains.
        gravity : array_like, (d,), optional
            Acceleration due to gravity, zero along periodic axes (length/time^2).
        bonds : dict of arrays, structured array or DataFrame, optional
            Contacts that act across gaps, with the arrays of `contacts`, of which kn is required.
        shapes : sequence of array_like (k, d), or of dicts, optional
            Vertices of each convex shape, or dicts with `vertices` and `rounding`, the radius by which its corners are
            rounded (length), as ``shapes`` of a state has them. Two vertices with rounding are a capsule, none a disk
            or sphere.
        shape : array_like of int, (n,), optional
            Index in `shapes` of the shape of each grain; by default 0, if there is one shape.
        scale : array_like, (n,), optional
            Factor by which the shape of each grain is magnified [1].
        orientation : array_like, (n,), in 3D (n, 4), optional
            Angles (radians) or quaternions in the order x, y, z, w that turn the vertices [no turn].
        touch_gap : float, optional
            Without `contacts`: largest gap at which grains and walls count as touching (length) [0]. Contacts with a gap
            get no force.
        wall_ids : dict, optional
            Walls among the bodies of `contacts`: their ids in id1 or id2, and their names, as in ``{0: "x-", 1: "x+"}``.

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
            If contacts, geometry, forces, law and equilibrium disagree, or if the arrays are interpreted: points that are
            no vertices of the convex hull, contacts with walls that are found, masses that weights follow from.
        """
        if wall_ids is not None and contacts is None and bonds is None:
            raise InputError("wall_ids: this argument says which bodies of contacts or bonds are walls, but none are given")
        cell = real_numbers("cell", cell)
        if cell.ndim == 1:
            cell = np.diag(cell)
        return cls(_core.from_arrays(
            position=real_numbers("position", position), radius=_radii(radius, shapes), cell=cell,
            shapes=_shape_arrays(shapes, shape, scale, orientation), law=_law_text(law),
            contacts=_contact_arrays(contacts, has_points=shapes is not None), bonds=_contact_arrays(bonds, "bonds"), walls=walls,
            wall_law=None if wall_law is None else _law_text(wall_law),
            wall_ids={} if wall_ids is None else _wall_ids(wall_ids), touch_gap=touch_gap,
            gravity=[] if gravity is None else unmasked("gravity", gravity), mass=None if mass is None else real_numbers("mass", mass),
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
    """Returns the state of a pickle, which holds the content of a state file and the name of the state."""
    with tempfile.TemporaryDirectory(prefix="floc-") as directory:
        path = pathlib.Path(directory) / "state.h5"
        path.write_bytes(content)
        return cls(_core.restore(os.fspath(path), name))


def states_of(state):
    """Returns a list of states, and whether the argument is a single state or path, not a sequence."""
    if isinstance(state, (_core.State, str, os.PathLike)):
        return [_one(state)], True
    if not isinstance(state, collections.abc.Iterable):
        return [_one(state)], False
    return [_one(one) for one in state], False


def _one(state):
    if isinstance(state, _core.State):
        return state
    if isinstance(state, (str, os.PathLike)):
        return read(state)
    raise TypeError(f"expected a State, the path of a state file, or several of these, not {type(state).__name__}")


def unmasked(name, values):
    """Returns `values`. Raises InputError if an entry is masked, because a masked entry has no value."""
    parts = [((k,), one) for k, one in enumerate(values)] if isinstance(values, (list, tuple)) else [((), values)]
    for at, part in parts:
        if isinstance(part, np.ma.MaskedArray) and np.ma.getmaskarray(part).any():
            at += tuple(int(i) for i in np.argwhere(np.ma.getmaskarray(part))[0])
            raise InputError(f"{name}[{', '.join(map(str, at))}]: this entry is masked, expected a value: leave masked "
                             "entries out")
    return values


def number(name, value):
    """Converts any real number of Python to a float."""
    try:
        if np.iscomplexobj(value):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} = {value!r}: expected a number") from None


def _index(name, value, n):
    """Converts any whole number of Python to an index below n."""
    try:
        index = operator.index(value)
    except TypeError:
        index = -1
    if not 0 <= index < n:
        raise InputError(f"{name} = {value!r}: expected a whole number from 0 to {n - 1}")
    return index


def real_numbers(name, values):
    """Converts to an array of floats. Raises InputError for entries that are masked, complex, or no numbers."""
    values = unmasked(name, values)
    try:
        array = np.asarray(values)
        if np.iscomplexobj(array):
            raise InputError(f"{name}: this array has complex numbers, expected real ones")
        return np.asarray(array, dtype=float)
    except (TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{name}: expected an array of numbers: {error}") from None


# Names of the arrays that may describe contacts; a structured array or data frame may have further fields.
_CONTACT_NUMBERS = ("image", "force", "normal_force", "shear_force", "rolling_moment", "twisting_moment", "kn", "kt", "kr",
                    "ktw", "bridge_volume")
# What contacts of grains with corners have besides.
_POINT_NUMBERS = ("point", "normal", "gap", "type")
# Fields of the contacts of a state, all zero if its law has no rolling or twisting moments; they are then left out.
_MOMENTS = ("rolling_moment", "twisting_moment")


def _integers(name, array):
    """Converts an array to integers of 64 bits. Whole numbers of a real type are accepted too: numpy.loadtxt reads them
    so."""
    if np.issubdtype(array.dtype, np.integer):
        if array.size and int(array.max()) > np.iinfo(np.int64).max:
            raise InputError(f"{name}: found {array.max()}, expected integers up to {np.iinfo(np.int64).max}")
        return array.astype(np.int64)
    whole = np.issubdtype(array.dtype, np.floating) and (np.abs(array) <= 2.0**53) & (array == np.floor(array))
    if not np.all(whole):
        raise InputError(f"{name} has values of type {array.dtype}, expected integers")
    return array.astype(np.int64)


def _radii(radius, shapes):
    if (radius is None) == (shapes is None):
        raise InputError("radius: expected the radii of disks or spheres, or None beside shapes, from which they follow")
    return None if radius is None else real_numbers("radius", radius)


# Keys of the dicts in State.shapes. Only the first two are read: the others follow from them.
_KEYS_OF_SHAPES = ("vertices", "rounding", "faces", "volume", "inertia", "outer_radius")


def _shape_arrays(shapes, shape, scale, orientation):
    poses = {"shape": shape, "scale": scale, "orientation": orientation}
    given = {name: array for name, array in poses.items() if array is not None}
    if shapes is None:
        if given:
            raise InputError(f"{next(iter(given))}: expected shapes beside it")
        return None
    if isinstance(shapes, str) or not isinstance(shapes, collections.abc.Iterable):
        raise InputError(f"shapes = {shapes!r}: expected a sequence of arrays of vertices")
    arrays = {"shapes": []}
    for k, one in enumerate(shapes):
        words = one if isinstance(one, dict) else {"vertices": one}
        if "vertices" not in words:
            raise InputError(f"shapes[{k}]: this dict has no vertices")
        for word in words:
            if word not in _KEYS_OF_SHAPES:
                raise InputError(f"shapes[{k}]: unknown key {word!r}, expected vertices and rounding")
        arrays["shapes"].append({"vertices": real_numbers(f"shapes[{k}]: vertices", words["vertices"]),
                                 "rounding": number(f"shapes[{k}]: rounding", words.get("rounding", 0.0))})
    for name, array in given.items():
        arrays[name] = _integers(name, np.asarray(unmasked(name, array))) if name == "shape" else real_numbers(name, array)
    return arrays


def _contact_arrays(contacts, what="contacts", has_points=False):
    if contacts is None:
        return None
    try:
        names = contacts.dtype.names if isinstance(contacts, np.ndarray) else list(contacts)
    except TypeError:
        names = None
    if names is None:
        raise InputError(f"{what}: expected a dict of arrays, a structured array or a data frame")
    known = ("id1", "id2", "wall", *_CONTACT_NUMBERS, *(_POINT_NUMBERS if has_points else ()))
    if isinstance(contacts, dict) and not set(names) <= set(known):
        raise InputError(f"{what}: {sorted(set(names) - set(known))[0]!r} is not one of {', '.join(known)}")
    arrays = {}
    for name in known:
        if name not in names:
            continue
        if name == "wall":
            if np.ndim(contacts[name]) != 1:
                raise InputError(f"{what}: wall = {contacts[name]!r}: expected names of walls, one per contact")
            arrays[name] = [str(wall) for wall in contacts[name]]
            continue
        words = f"{what}: {name}"
        whole = name in ("id1", "id2", "image", "type")
        given = unmasked(words, contacts[name])
        array = _integers(words, np.asarray(given)) if whole else real_numbers(words, given)
        if name in _MOMENTS and isinstance(contacts, np.ndarray) and not array.any():
            continue
        arrays[name] = array
    return arrays


def _wall_ids(wall_ids):
    if not isinstance(wall_ids, collections.abc.Mapping):
        raise InputError(f"wall_ids = {wall_ids!r}: expected a dict of ids of bodies and names of walls, such as "
                         "{0: \"x-\", 1: \"x+\"}")
    ids = _integers("wall_ids", np.asarray(list(wall_ids), dtype=None if wall_ids else int))
    return dict(zip(ids.tolist(), wall_ids.values()))


def _law_text(law):
    if isinstance(law, str):
        return law
    if not isinstance(law, dict):
        raise InputError(f"law = {law!r}: expected a dict or a string with the keys of Packing.from_arrays")
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
