"""Pictures of packings with matplotlib."""
import numpy as np

from ._errors import InputError
from ._state import number, states_of

__all__ = ["forces"]

# The colours of ``floc draw``.
_COMPRESSION, _TENSION, _DISTANT, _ZERO = "#0072B2", "#D55E00", "#00B377", "#5A5A5A"
_GRAIN, _OUTLINE = "#EFEFEF", "#A6A6A6"


def forces(state, ax=None, *, width=2.0, grains=True, plane=(0, 1), zero=1e-5):
    """Draws the force network of a state: one line per contact, whose width is proportional to the normal force.

    Compression is blue, tension orange, attraction across a gap green; contacts without force are thin and grey. A
    contact across the periodic boundary is drawn at both of its ends.

    Parameters
    ----------
    state : State or path-like
    ax : matplotlib.axes.Axes, optional
        Axes in which the picture is drawn [new axes].
    width : float
        Line width of the root mean square force (points).
    grains : bool
        Whether grains are drawn below the lines.
    plane : (int, int)
        Axes of space that are drawn horizontally and vertically; a packing of spheres is seen along the third axis.
    zero : float
        Fraction of the root mean square force below which a contact is drawn as a contact without force.

    Returns
    -------
    matplotlib.collections.LineCollection
        The lines, in the order of the contacts, followed by the second lines of contacts across the boundary.

    Raises
    ------
    InputError
        If `plane` does not name two axes of the packing.
    ImportError
        If matplotlib is not installed.
    """
    try:
        import matplotlib.pyplot as plt
        from matplotlib.collections import EllipseCollection, LineCollection
    except ImportError as error:
        raise ImportError("floc.plot needs matplotlib: Debian's package is python3-matplotlib") from error
    width, zero = number("width", width), number("zero", zero)
    if not 0.0 < width < np.inf:
        raise InputError(f"width = {width}: expected a positive number")
    if not 0.0 <= zero < np.inf:
        raise InputError(f"zero = {zero}: expected zero or a positive number")
    (state,), _ = states_of(state)
    if np.ndim(plane) != 1 or not all(isinstance(axis, (int, np.integer)) for axis in plane):
        raise InputError(f"plane = {plane!r}: expected two whole numbers")
    plane = list(plane)
    if sorted(set(plane) & set(range(state.dimension))) != sorted(plane) or len(plane) != 2:
        raise InputError(f"plane = {tuple(plane)}: expected two different axes from 0 to {state.dimension - 1}")
    if ax is None:
        _, ax = plt.subplots()
    if grains:
        diameter = 2.0 * state.radius
        ax.add_collection(EllipseCollection(
            diameter, diameter, np.zeros(state.n_grains), units="xy", offsets=state.position[:, plane],
            offset_transform=ax.transData, facecolors=_GRAIN, edgecolors=_OUTLINE, linewidths=0.4, zorder=1))
    segments, force, distant = _segments(state)
    size = np.abs(force)
    typical = np.sqrt(np.mean(size**2)) if size.any() else 1.0
    colors = np.where(size < zero * typical, _ZERO,
                      np.where(distant, _DISTANT, np.where(force > 0.0, _COMPRESSION, _TENSION)))
    lines = LineCollection(segments[:, :, plane], colors=list(colors), linewidths=0.1 + width * size / typical,
                           capstyle="round", zorder=2)
    ax.add_collection(lines)
    _frame(ax, state, plane)
    return lines


def _segments(state):
    """Returns the ends of all lines, their normal forces, and whether they act across a gap: one line per contact, and
    then the lines from the second grain of contacts across the boundary."""
    contacts, x, radius = state.contacts, state.position, state.radius
    wall = contacts["id2"] >= state.n_grains
    reach = radius[contacts["id1"]] + contacts["gap"] + np.where(wall, 0.0, radius[np.where(wall, 0, contacts["id2"])])
    branch = reach[:, None] * contacts["normal"]
    begin = x[contacts["id1"]]
    across = ~wall & contacts["image"].any(axis=1)
    end = x[contacts["id2"][across]]
    segments = np.concatenate([np.stack([begin, begin + branch], axis=1),
                               np.stack([end - branch[across], end], axis=1)])
    both = [np.concatenate([contacts[name], contacts[name][across]]) for name in ("normal_force", "distant")]
    return segments, *both


def _frame(ax, state, plane):
    """Draws the outline of the cell, and sets the limits of the axes around it with equal scales."""
    cell = state.cell[plane][:, plane]
    corner = np.zeros(2)
    if state.walls:
        below = {w["axis"]: w["position"] for w in state.walls if w["side"] < 0}
        corner = np.array([below.get(a, 0.0) for a in plane])
    outline = corner + np.array([[0, 0], cell[0], cell[0] + cell[1], cell[1], [0, 0]])
    ax.plot(*outline.T, color="#707070", linewidth=0.8, zorder=3)
    margin = float(state.radius.max()) if state.n_grains else 0.0
    low, high = outline.min(axis=0) - margin, outline.max(axis=0) + margin
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
