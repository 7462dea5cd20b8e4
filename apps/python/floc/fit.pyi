from collections.abc import Mapping, Sequence
from os import PathLike as _PathLike
from typing import Any

import numpy.typing as npt

from . import Record as _Record
from . import State as _State

_Curve = npt.ArrayLike | Sequence[npt.ArrayLike]
_Branch = Sequence[str] | Sequence[Sequence[str] | None] | None
_Columns = Mapping[str, str | float] | None

class Parameter(_Record):
    value: float | None
    stderr: float | None
    low95: float | None
    high95: float | None
    identified: bool
    @property
    def interval(self) -> tuple[float | None, float | None]: ...

class Fit:
    parameters: dict[str, Parameter]
    refusal: str | None
    sample: str
    warnings: list[str]
    def __init__(self, values: dict[str, Any]) -> None: ...
    @property
    def found(self) -> bool: ...
    def __getattr__(self, name: str) -> Any: ...
    def __getitem__(self, parameter: str) -> Parameter: ...
    def to_dict(self) -> dict[str, Any]: ...

class LoadPath:
    name: str
    reading: str
    notes: list[str]
    unit: str | None
    pressure: npt.NDArray[Any]
    solid_fraction: npt.NDArray[Any]
    branch: list[str]
    def __init__(self, values: dict[str, Any]) -> None: ...
    def __len__(self) -> int: ...

def read_table(
    table: str | _PathLike[str], *, columns: _Columns = None,
    phi_limit: float | None = 1.0) -> LoadPath: ...
def consolidation(
    pressure: _Curve | str | _PathLike[str], solid_fraction: _Curve | None = None, *,
    void_ratio: _Curve | None = None, branch: _Branch = None, law: str = "auto",
    window: tuple[float, float] | None = None, P0: float | None = None, protocol: str | None = None,
    loading: str | None = None, weights: str | None = None, loss: str = "squared", bootstrap: int = 0, seed: int = 1,
    stress: str | None = None, phi_limit: float | None = 1.0, columns: _Columns = None) -> Fit | list[Fit]: ...
def compression(
    pressure: _Curve | str | _PathLike[str], solid_fraction: _Curve | None = None, *,
    void_ratio: _Curve | None = None, branch: _Branch = None, law: str = "all", density: str = "out-of-die",
    D0: float | None = None, phi_limit: float | None = 1.0,
    columns: _Columns = None) -> list[Fit]: ...
def preconsolidation(
    pressure: _Curve | str | _PathLike[str], solid_fraction: _Curve | None = None, *,
    void_ratio: _Curve | None = None, branch: _Branch = None, branches: str | None = None,
    phi_limit: float | None = 1.0, columns: _Columns = None) -> list[Fit]: ...
def elastic(
    pressure: _Curve | str | _PathLike[str], solid_fraction: _Curve | None = None, *,
    void_ratio: _Curve | None = None, branch: _Branch = None, state: str | _PathLike[str] | None = None,
    phi_limit: float | None = 1.0, columns: _Columns = None) -> list[Fit]: ...
def cycle(
    pressure: _Curve | str | _PathLike[str], solid_fraction: _Curve | None = None, *,
    void_ratio: _Curve | None = None, branch: _Branch = None, phi_limit: float | None = 1.0,
    columns: _Columns = None) -> dict[str, npt.NDArray[Any]]: ...
def moduli(
    tables: str | _PathLike[str] | Sequence[str | _PathLike[str]], *, moduli: str | Sequence[str] | None = None,
    branch: str = "first", phi_limit: float | None = 1.0, columns: _Columns = None) -> list[Fit]: ...
def strength(
    tables: str | _PathLike[str] | Sequence[str | _PathLike[str]], *, kind: str = "drained",
    critical_from: float | None = None, modulus: tuple[float, float] | None = None,
    columns: _Columns = None) -> list[Fit]: ...
def dynamic_compaction(
    e: npt.ArrayLike, p: npt.ArrayLike, sc: npt.ArrayLike, se: npt.ArrayLike, *, p_D: float | None = None,
    eta_m: float | None = None, plateau: str = "p", p_0: float | None = None) -> Fit: ...
def force_distribution(
    forces: npt.ArrayLike | _State | str | _PathLike[str], *, form: str = "all", threshold: float | None = None,
    draws: int | None = None, seed: int | None = None) -> list[Fit]: ...
