from collections.abc import Callable as _Callable
from collections.abc import Iterable as _Iterable
from collections.abc import Iterator as _Iterator
from collections.abc import Mapping as _Mapping
from collections.abc import Sequence as _Sequence
from os import PathLike as _PathLike
from pathlib import Path as _Path
from typing import Any as _Any
from typing import TypeVar as _TypeVar
from typing import overload as _overload

import numpy as _np
import numpy.typing as _npt

from . import fit as fit
from . import plot as plot

__version__: str
commit: str

_Array = _npt.NDArray[_np.float64]
_Table = dict[str, _npt.NDArray[_Any]]
_OneState = State | str | _PathLike[str]
_R = _TypeVar("_R", bound=Record)

class Error(Exception): ...
class InputError(Error, ValueError): ...
class FileError(Error, OSError): ...
class NumericalError(Error, ArithmeticError): ...
class EquilibriumError(NumericalError): ...
class FlocWarning(UserWarning): ...

class State:
    def __init__(self, other: State) -> None: ...
    position: _Array
    ids: _Array
    position_low: _Array | None
    velocity: _Array
    radius: _Array
    mass: _Array
    orientation: _Array
    angular_velocity: _Array
    contacts: _npt.NDArray[_np.void]
    cell: _Array
    stress: _Array
    target_stress: _Array
    dimension: int
    n_grains: int
    n_contacts: int
    pressure: float
    reduced_pressure: float
    solid_fraction: float
    void_ratio: float
    residuals: dict[str, float]
    tolerance: dict[str, float]
    equilibrium_faults: str
    name: str
    units: str
    law: str
    walls: list[dict[str, float]]
    path: dict[str, _Any]
    shapes: list[dict[str, _Any]] | None
    shape: _Array | None
    scale: _Array | None
    motion: dict[str, float] | None
    scene: str
    provenance: dict[str, _Any]
    def vertices(self, grain: int) -> _Array: ...
    def write(self, path: str | _PathLike[str]) -> None: ...

class Packing(State):
    @classmethod
    def from_arrays(
        cls, position: _npt.ArrayLike, radius: _npt.ArrayLike | None, cell: _npt.ArrayLike,
        law: str | _Mapping[str, _Any],
        contacts: _Mapping[str, _npt.ArrayLike] | _npt.NDArray[_np.void] | None = None, *,
        mass: _npt.ArrayLike | None = None, stress: _Iterable[float] | None = None, tolerance: float | None = None,
        units: str = "reduced", drop_tensile: bool = False, ids: _npt.ArrayLike | None = None, walls: str = "",
        wall_law: str | _Mapping[str, _Any] | None = None, gravity: _npt.ArrayLike | None = None,
        bonds: _Mapping[str, _npt.ArrayLike] | _npt.NDArray[_np.void] | None = None,
        shapes: _Iterable[_npt.ArrayLike | _Mapping[str, _Any]] | None = None, shape: _npt.ArrayLike | None = None,
        scale: _npt.ArrayLike | None = None, orientation: _npt.ArrayLike | None = None,
        touch_gap: float | None = None, wall_ids: _Mapping[int, str] | None = None) -> Packing: ...

class Record(_Mapping[str, _Any]):
    tables: dict[str, _Table]
    def __init__(self, names: _Iterable[str], values: _Iterable[_Any],
                 tables: dict[str, _Table] | None = None) -> None: ...
    def __getattr__(self, name: str) -> _Any: ...
    def __getitem__(self, name: str) -> _Any: ...
    def __iter__(self) -> _Iterator[str]: ...
    def __len__(self) -> int: ...
    def to_dict(self) -> dict[str, _Any]: ...

class Records(list[_R]):
    tables: dict[str, _Table]
    def __init__(self, rows: _Iterable[_R], tables: dict[str, _Table] | None = None) -> None: ...
    def to_dict(self) -> dict[str, list[_Any]]: ...

class Moduli(Record):
    file: str
    dimension: int | None
    n_grains: int | None
    n_contacts: int | None
    n_distant: int | None
    P: float | None
    P_star: float | None
    phi: float | None
    z: float | None
    C11: float | None
    C22: float | None
    C12: float | None
    B: float | None
    B_S: float | None
    G: float | None
    isotropy_defect: float | None
    B_voigt: float | None
    G_voigt: float | None
    B_reuss: float | None
    B_voigt_printed: float | None
    G_voigt_printed: float | None
    B_reuss_printed: float | None
    Z2: float | None
    n_negative: int | None
    n_mechanisms: int | None
    n_coupled_mechanisms: int | None
    residual: float | None
    condition: float | None
    seconds: float | None
    units: str
    n_rattlers: int | None
    n_free_rollers: int | None
    n_at_cap: int | None
    error_C: float | None
    error_B: float | None
    error_B_S: float | None
    error_G: float | None
    n_dead_ends: int | None
    n_components: int | None
    n_percolating: int | None
    n_near_mechanisms: int | None
    B_prestress: float | None
    G_prestress: float | None
    x0: float | None
    z_star: float | None
    G_star: float | None
    indeterminacy: int | None
    energy_share_95: float | None
    energy_share_95_deviatoric: float | None
    backbone_share: float | None
    scalar_backbone_share: float | None
    rounding_floor: float | None
    residual_force: float | None
    n_undecided: int | None
    error_B_equilibrium: float | None
    error_B_sampling: float | None
    limited_by: str
    C13: float | None
    C14: float | None
    C15: float | None
    C16: float | None
    C23: float | None
    C24: float | None
    C25: float | None
    C26: float | None
    C33: float | None
    C34: float | None
    C35: float | None
    C36: float | None
    C44: float | None
    C45: float | None
    C46: float | None
    C55: float | None
    C56: float | None
    C66: float | None
    rolling_stiffness: float | None
    B_without_prestress: float | None
    G_without_prestress: float | None
    method: str
    G_voigt_smooth_mean_field: float | None
    B_reuss_mean_field: float | None
    Z_hat: float | None
    G_shear: float | None
    E_1: float | None
    E_2: float | None
    E_3: float | None
    nu_12: float | None
    nu_13: float | None
    nu_21: float | None
    nu_23: float | None
    nu_31: float | None
    nu_32: float | None
    p_wall: float | None
    bounds_hold: bool | None
    bounds_hold_B_S: bool | None
    seconds_row: float | None
    P_driven: float | None
    P_driven_star: float | None
    kn_named: float | None
    kt_named: float | None
    stiffness_per: float | None

class Network(Record):
    file: str
    dimension: int | None
    n_grains: int | None
    n_contacts: int | None
    n_distant: int | None
    P: float | None
    P_star: float | None
    phi: float | None
    z: float | None
    z_plus: float | None
    z_minus: float | None
    z_zero: float | None
    z_with_distant: float | None
    n_rattlers: int | None
    x0: float | None
    z_star: float | None
    x22: float | None
    mean_normal_force: float | None
    largest_normal_force: float | None
    moment_2: float | None
    moment_3: float | None
    moment_4: float | None
    M1: float | None
    M2: float | None
    pressed_share: float | None
    pressed_mean: float | None
    pressed_largest: float | None
    pressed_percolates: float | None
    pulled_share: float | None
    pulled_mean: float | None
    pulled_largest: float | None
    pulled_percolates: float | None
    indeterminacy: int | None
    n_dead_ends: int | None
    n_components: int | None
    n_percolating: int | None
    energy_share_95: float | None
    energy_share_95_deviatoric: float | None
    backbone_share: float | None
    scalar_backbone_share: float | None
    correlation_normal: float | None
    correlation_size: float | None
    seconds: float | None
    units: str
    n_carrying: int | None
    z_carrying: float | None
    x0_carrying: float | None
    x2: float | None
    z_star_carrying: float | None
    z_star_star: float | None
    hyperstaticity: int | None
    n_null_modes: int | None
    Z_1_3: float | None
    Z_5_3: float | None
    Z_2: float | None
    M1_carrying: float | None
    M2_carrying: float | None
    sliding_share: float | None
    energy_per_grain: float | None
    p_max: float | None
    stress_spread: float | None
    fabric11: float | None
    fabric12: float | None
    fabric13: float | None
    fabric22: float | None
    fabric23: float | None
    fabric33: float | None
    strong_fabric11: float | None
    strong_fabric12: float | None
    strong_fabric13: float | None
    strong_fabric22: float | None
    strong_fabric23: float | None
    strong_fabric33: float | None
    weak_fabric11: float | None
    weak_fabric12: float | None
    weak_fabric13: float | None
    weak_fabric22: float | None
    weak_fabric23: float | None
    weak_fabric33: float | None
    n_bonds: int | None
    z_bonds: float | None
    z_bonds_plus: float | None
    z_bonds_minus: float | None
    z_bonds_near_zero: float | None
    minus_share: float | None
    mean_plus: float | None
    mean_minus: float | None
    virial_strength: float | None
    rumpf_strength: float | None
    p0: float | None
    n_signed_bonds: int | None
    like_share: float | None
    like_share_shuffled: float | None
    like_share_shuffled_stddev: float | None
    positive_along: str
    negative_along: str
    positive_clusters: float | None
    negative_clusters: float | None
    positive_largest_cluster: float | None
    negative_largest_cluster: float | None
    positive_largest_cluster_shuffled: float | None
    negative_largest_cluster_shuffled: float | None
    positive_directions: float | None
    negative_directions: float | None
    positive_directions_shuffled: float | None
    negative_directions_shuffled: float | None
    positive_percolates_shuffled: float | None
    negative_percolates_shuffled: float | None
    p_wall: float | None
    P_driven: float | None
    P_driven_star: float | None
    n_solid_bonds: int | None
    z_pairs_star: float | None
    pairs_vertex_face: float | None
    pairs_edge_edge: float | None
    pairs_edge_face: float | None
    pairs_face_face: float | None
    force_vertex_face: float | None
    force_edge_edge: float | None
    force_edge_face: float | None
    force_face_face: float | None
    a_normals: float | None
    a_normal_force: float | None
    a_tangential_force: float | None
    a_branch_normal: float | None
    a_branch_tangential: float | None
    stress_ratio: float | None
    stress_ratio_predicted: float | None
    below_mean: float | None
    alpha: float | None
    alpha_error: float | None
    beta: float | None
    beta_error: float | None
    below_mean_pairs: float | None
    alpha_pairs: float | None
    alpha_pairs_error: float | None
    beta_pairs: float | None
    beta_pairs_error: float | None
    mobilisation: float | None
    long_axes_order: float | None
    long_axis1: float | None
    long_axis2: float | None
    long_axis3: float | None
    beta2: float | None
    beta2_error: float | None
    beta2_pairs: float | None
    beta2_pairs_error: float | None

class Structure(Record):
    file: str
    dimension: int | None
    n_grains: int | None
    P_star: float | None
    phi: float | None
    xi: float | None
    xi_stderr: float | None
    xi_low95: float | None
    xi_high95: float | None
    dF: float | None
    dF_stderr: float | None
    dF_low95: float | None
    dF_high95: float | None
    I0: float | None
    I0_stderr: float | None
    I0_low95: float | None
    I0_high95: float | None
    fit_low: float | None
    fit_high: float | None
    fit_points: int | None
    chi_square: float | None
    mesh_spacing: float | None
    mesh1: int | None
    mesh2: int | None
    n_pores: int | None
    pore_size: float | None
    pore_mean_area: float | None
    pore_unbounded: bool | None
    seconds: float | None
    local_phi_mean: float | None
    local_phi_stddev: float | None
    n_voids: int | None
    void_radius_mean: float | None
    void_radius_largest: float | None
    P_driven_star: float | None

class Forces(Record):
    file: str
    dimension: int | None
    n_grains: int | None
    n_contacts: int | None
    n_carrying: int | None
    selection: str
    friction: float | None
    mean_normal_force: float | None
    mobilised: float | None
    net_force_before: float | None
    net_force: float | None
    net_moment: float | None
    stress_error: float | None
    moved: float | None
    force_freedom: float | None
    n_factorizations: int | None

class Comparison(Record):
    before: str
    after: str
    n_grains: int | None
    P_star_before: float | None
    P_star_after: float | None
    phi_before: float | None
    phi_after: float | None
    n_before: int | None
    n_after: int | None
    n_kept: int | None
    n_lost: int | None
    n_gained: int | None
    n_parted: int | None
    kept_share: float | None
    kept_share_after: float | None
    lost_share: float | None
    gained_share: float | None
    displacement_rms: float | None
    displacement_largest: float | None
    n_rigid: int | None
    rigid_share: float | None
    rigid_largest: int | None
    strain11: float | None
    strain12: float | None
    strain13: float | None
    strain22: float | None
    strain23: float | None
    strain33: float | None

class Plan(Record):
    plan: int | None
    observable: str
    error: float | None
    n_grains: int | None
    n_samples: int | None
    knob: str
    value: str
    cpu_hours: float | None
    wall_hours: float | None
    memory_mb: float | None
    error_settings: float | None
    error_size: float | None
    error_scatter: float | None
    tolerance: float | None
    time_step: float | None
    finish: str
    patience: float | None
    kind: str
    softening: float | None
    assembly_softening: float | None
    masses: str

class PlanCheck(Record):
    quantity: str
    unit: str
    promised: float | None
    achieved: float | None
    ratio: float | None
    mean: float | None
    n_samples: int | None

class Plans(Records[Plan]):
    remarks: list[str]
    def __init__(self, rows: _Iterable[Plan], remarks: list[str]) -> None: ...

class Compliance(Record):
    formula: float | None
    solved: float | None
    error_bound: float | None

class Chain(Record):
    axial: Compliance
    transverse: Compliance
    rolling: Compliance
    end_disk_deflection: Compliance

class Progress:
    step: int
    n_steps: int
    branch: str
    pressure: float
    solid_fraction: float
    time: float
    equilibrium: bool
    def __init__(self, step: int, n_steps: int, branch: str, pressure: float, solid_fraction: float, time: float,
                 equilibrium: bool) -> None: ...

class Run:
    directory: _Path
    states: list[_Path]
    path: _Table
    def __init__(self, directory: str | _PathLike[str]) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, k: int | slice) -> _Any: ...

def columns(table: str) -> list[tuple[str, str, str]]: ...
def read(path: str | _PathLike[str]) -> State: ...
@_overload
def moduli(
    state: _OneState, strains: str = "diagonal", *, prestress: bool = False,
    tolerance: float | None = None, method: str = "factor", accuracy: float | _Mapping[str, float] | None = None,
    force_tolerance: float | None = None, rolling_stiffness: float | _Sequence[float] | None = None,
    kn: float | None = None, kt: float | None = None, stiffness_per: str = "point",
    tables: str | _Iterable[str] = (), force: bool = False) -> Moduli: ...
@_overload
def moduli(
    state: _Iterable[_OneState], strains: str = "diagonal", *, prestress: bool = False,
    tolerance: float | None = None, method: str = "factor", accuracy: float | _Mapping[str, float] | None = None,
    force_tolerance: float | None = None, rolling_stiffness: float | _Sequence[float] | None = None,
    kn: float | None = None, kt: float | None = None, stiffness_per: str = "point",
    tables: str | _Iterable[str] = (), force: bool = False) -> Records[Moduli]: ...
@_overload
def network(
    state: _OneState, *, zero_force: float | None = None, least_contacts: int | None = None,
    unit: str = "mean", bin_width: float = 0.1, groups: str | _Iterable[str] = (), near_zero: float = 0.02,
    shuffles: int = 20, pressure_bin_width: float = 0.1, without: str | _Iterable[str] = (),
    tables: str | _Iterable[str] = ()) -> Network: ...
@_overload
def network(
    state: _Iterable[_OneState], *, zero_force: float | None = None, least_contacts: int | None = None,
    unit: str = "mean", bin_width: float = 0.1, groups: str | _Iterable[str] = (), near_zero: float = 0.02,
    shuffles: int = 20, pressure_bin_width: float = 0.1, without: str | _Iterable[str] = (),
    tables: str | _Iterable[str] = ()) -> Records[Network]: ...
@_overload
def structure(
    state: _OneState, *, average: bool = False, fit_range: _Sequence[float] = (0.0, 1.0),
    largest_k: float | None = None, cells_per_wave: float | None = None, reach: float = 5.0,
    map_size: _Sequence[int] = (32, 32), probes: int = 40, profile_axis: str | None = None, slices: int = 20,
    tables: str | _Iterable[str] = ()) -> Structure: ...
@_overload
def structure(
    state: _Iterable[_OneState], *, average: bool = False, fit_range: _Sequence[float] = (0.0, 1.0),
    largest_k: float | None = None, cells_per_wave: float | None = None, reach: float = 5.0,
    map_size: _Sequence[int] = (32, 32), probes: int = 40, profile_axis: str | None = None, slices: int = 20,
    tables: str | _Iterable[str] = ()) -> Records[Structure]: ...
def compare(before: _OneState, after: _OneState, *, rigid_tolerance: float = 0.01,
            tables: str | _Iterable[str] = ()) -> Comparison: ...
@_overload
def forces(
    state: _OneState, *, selection: str | None = None, friction: float | None = None, kn: float | None = None,
    kt: float | None = None, stress: float | _Sequence[float] = (), gap: float | None = None,
    tables: str | _Iterable[str] = (), ranges: bool = False, range_of: _Sequence[int] = ()) -> Forces: ...
@_overload
def forces(
    state: _Iterable[_OneState], *, selection: str | None = None, friction: float | None = None,
    kn: float | None = None, kt: float | None = None, stress: float | _Sequence[float] = (), gap: float | None = None,
    tables: str | _Iterable[str] = (), ranges: bool = False, range_of: _Sequence[int] = ()) -> Records[Forces]: ...
def chain(n: int, R: float, kn: float, kt: float, kr: float, bend: float = 0.0) -> Chain: ...
def run(
    scene: str | _PathLike[str], directory: str | _PathLike[str], *,
    on_progress: _Callable[[Progress], object] | None = None, interval: float = 0.5,
    changes: _Mapping[str, _Any] | None = None, seed: int | None = None, threads: int | None = None,
    until: int | None = None, track_contacts: float | None = None, track_energy: bool = False, resume: bool = False,
    overwrite: bool = False, timing: bool = True, prices: str | _PathLike[str] | None = None) -> Run: ...
def plan(
    scene: str | _PathLike[str], *, budget: str | float | None = None, want: _Mapping[str, float] | None = None,
    cores: int = 1, observables: str | _Iterable[str] = (), changes: _Mapping[str, _Any] | None = None,
    prices: str | _PathLike[str] | None = None, pilot: bool = False,
    output: str | _PathLike[str] | None = None, overwrite: bool = False) -> Plans: ...
def check_plan(directory: str | _PathLike[str]) -> Records[PlanCheck]: ...
