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

    Lines run from centre to centre, through the contact point where grains have corners. Compression is blue, tension
    orange, attraction across a gap green; contacts without force are thin and grey. A contact across the periodic boundary
    is drawn at both of its ends.

    Parameters
    ----------
    state : State or path-like
    ax : matplotlib.axes.Axes, optional
        Axes in which the picture is drawn [new axes].
    width : float
        Line width of the root mean square force (points).
    grains : bool
        Whether grains are drawn below the lines: disks, or outlines of grains with corners.
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
        from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
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
    if grains and state.shapes is not None:
        ax.add_collection(PolyCollection([_outline(state, i, plane) for i in range(state.n_grains)], facecolors=_GRAIN,
                                         edgecolors=_OUTLINE, linewidths=0.4, zorder=1))
    elif grains:
        diameter = 2.0 * state.radius
        ax.add_collection(EllipseCollection(
            diameter, diameter, np.zeros(state.n_grains), units="xy", offsets=state.position[:, plane],
            offset_transform=ax.transData, facecolors=_GRAIN, edgecolors=_OUTLINE, linewidths=0.4, zorder=1))
    segments, force, distant = _segments(state)
    size = np.abs(force)
    # A contact across the boundary has two lines, but counts once.
    typical = np.sqrt(np.mean(size[:state.n_contacts]**2)) if size.any() else 1.0
    colors = np.where(size < zero * typical, _ZERO,
                      np.where(distant, _DISTANT, np.where(force > 0.0, _COMPRESSION, _TENSION)))
    lines = LineCollection(segments[:, :, plane], colors=list(colors), linewidths=0.1 + width * size / typical,
                           capstyle="round", zorder=2)
    ax.add_collection(lines)
    _frame(ax, state, plane)
    return lines


def _segments(state):
    """Returns the points of all lines (n, 2 or 3, d), their normal forces, and whether they act across a gap: one line per
    contact, and then the lines from the second grain of contacts across the boundary. Lines of grains with corners bend
    at the contact point, and end there at a wall."""
    contacts, x = state.contacts, state.position
    wall = contacts["id2"] >= state.n_grains
    begin = x[contacts["id1"]]
    # Vector from the first centre to the end of the line: the image of the second centre, or the point on the wall.
    branch = x[np.where(wall, 0, contacts["id2"])] + contacts["image"] @ state.cell - begin
    shaped = state.shapes is not None
    reach = state.radius[contacts["id1"]] + contacts["gap"]
    on_wall = contacts["point"] if shaped else reach[:, None] * contacts["normal"]
    branch = np.where(wall[:, None], on_wall, branch)
    steps = [np.zeros_like(branch), contacts["point"], branch] if shaped else [np.zeros_like(branch), branch]
    lines = begin[:, None] + np.stack(steps, axis=1)
    across = ~wall & contacts["image"].any(axis=1)
    shift = (contacts["image"][across] @ state.cell)[:, None]
    segments = np.concatenate([lines, lines[across] - shift])
    both = [np.concatenate([contacts[name], contacts[name][across]]) for name in ("normal_force", "distant")]
    return segments, *both


def _outline(state, grain, plane, n_arc=24):
    """Returns the outline (k, 2) of a grain with corners as it is seen in a plane: the convex hull of its vertices, with
    arcs of `n_arc` points a turn where they are rounded."""
    rounding = state.scale[grain] * state.shapes[state.shape[grain]]["rounding"]
    corners = _hull(state.vertices(grain)[:, plane])
    if len(corners) == 0:
        corners = state.position[grain, plane][None]
    if rounding == 0.0:
        return corners
    sides = np.roll(corners, -1, axis=0) - corners
    # Directions of the outward normals of the sides; at each corner the arc runs from one side's to the next one's.
    after = np.arctan2(-sides[:, 0], sides[:, 1])
    turn = np.mod(after - np.roll(after, 1), 2 * np.pi) if len(corners) > 1 else np.array([2 * np.pi])
    points = []
    for corner, end, angle in zip(corners, after, turn):
        directions = np.linspace(end - angle, end, 2 + int(n_arc * angle / (2 * np.pi)))
        points.append(corner + rounding * np.stack([np.cos(directions), np.sin(directions)], axis=1))
    return np.concatenate(points)


def _hull(points):
    """Returns the corners of the convex hull of points in a plane, counter-clockwise."""
    ordered = sorted(set(map(tuple, points)))
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0.0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


def _turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


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
