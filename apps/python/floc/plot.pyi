from os import PathLike as _PathLike

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from . import State as _State

def forces(
    state: _State | str | _PathLike[str], ax: Axes | None = None, *, width: float = 2.0, grains: bool = True,
    plane: tuple[int, int] = (0, 1), zero: float = 1e-5) -> LineCollection: ...
