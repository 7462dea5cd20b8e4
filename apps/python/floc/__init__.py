"""floc: static packings of disks and spheres, and the mechanics of their contact networks.

    >>> import floc
    >>> run = floc.run("data/scenes/demo.toml", "demo")
    >>> state = run[26]
    >>> floc.moduli(state).B
    >>> floc.fit.consolidation("demo")["lambda"].interval

Results are equal to those of the floc commands, bit for bit. docs/python.md is the manual;
``floc.columns("moduli")`` describes the columns of a table.
"""
try:
    import numpy as _numpy
except ImportError as error:
    raise ImportError("floc needs numpy: Debian's package is python3-numpy") from error
del _numpy

from . import fit, plot
from ._analysis import (Chain, Comparison, Compliance, Forces, Moduli, Network, Structure, chain, compare, forces,
                        moduli, network, structure)
from ._core import commit, version as __version__
from ._errors import EquilibriumError, Error, FileError, FlocWarning, InputError, NumericalError
from ._plan import Plan, PlanCheck, Plans, check_plan, plan
from ._records import Record, Records, columns
from ._run import Progress, Run, run
from ._state import Packing, State, read

__all__ = ["Chain", "Comparison", "Compliance", "EquilibriumError", "Error", "FileError", "FlocWarning", "Forces",
           "InputError", "Moduli", "Network", "NumericalError", "Packing", "Plan", "PlanCheck", "Plans", "Progress",
           "Record", "Records", "Run", "State", "Structure", "chain", "check_plan", "columns", "commit", "compare",
           "fit", "forces", "moduli", "network", "plan", "plot", "read", "run", "structure"]
