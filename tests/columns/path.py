"""The columns of path.csv of a run, from the states of the run."""
import numpy as np

from checks import Close, Exempt, Holds, Same
from info import n_negative, residual_columns
from rigid import force_freedom

TABLES = {"path.csv": "of floc run"}


def axes_columns(s, first, before):
    """Returns stresses and strains along the axes, and the results of a test with a driven axis."""
    stress = np.diag(s.stress)
    scale = s.stress_scale

    def strain(state):
        return np.log(np.diag(first.cell) / np.diag(state.cell))

    control, axis = s.path_attributes.get("control"), s.path_attributes.get("axis")
    driven = (axis if axis else s.dim) - 1
    others = np.delete(stress, driven).mean()
    q, p = stress[driven] - others, stress.mean()
    unloaded = not s.target.any()
    out = {f"stress_{a + 1}": Close(stress[a], scale) for a in range(s.dim)}
    out |= {f"strain_{a + 1}": Close(strain(s)[a], 1.0) for a in range(s.dim)}
    ratio = Exempt("of stresses that are zero") if unloaded else None
    out |= {"p": Close(p, scale), "q": Close(q, scale), "K0": ratio or Close(others / stress[driven], 1.0),
            "volumetric_strain": Close(strain(s).sum(), 1.0), "control": Same(control or None), "axis": Same(axis or None)}
    sheared = control == "simple_shear"
    shear_stress = -s.stress[0, driven]
    mobilised = shear_stress / stress[driven] if sheared else q / (stress.sum() if s.dim == 2 else p)
    out["mobilised_friction"] = Close(mobilised if axis else None, 1.0)
    out["dilatancy"] = Same(None)
    if axis and not sheared:
        step = strain(s) - strain(before)
        deviatoric = (step[driven] - np.delete(step, driven).mean()) * (1 if s.dim == 2 else 2 / 3)
        out["dilatancy"] = Close(-step.sum() / deviatoric)
    # The shear strain of one step is the change of the offset of the lattice vector along the first axis, divided by
    # the height before the step.
    offset = (s.cell[driven, 0] - before.cell[driven, 0]) / before.cell[driven, driven] if sheared else None
    out["shear_strain"] = Close(offset, 1.0)
    out["shear_stress"] = Close(shear_stress if sheared else None, scale)
    return out


def least_mechanisms(s):
    """Returns the number of unknowns of grains with two contacts or more, minus the number of springs."""
    held = np.ones(s.n, bool)
    inner = np.where(s.on_wall, 0, s.j)
    while True:
        kept = held[s.i] & (s.on_wall | held[inner])
        count = np.bincount(s.i[kept], minlength=s.n) + np.bincount(s.j[kept & ~s.on_wall], minlength=s.n)
        if not (held & (count < 2)).any():
            break
        held &= count >= 2
    springs = (1 + (s.kt > 0) * (s.dim - 1) + (s.kr > 0) * (s.dim - 1) + (s.ktw > 0))[kept].sum()
    unknowns = 0
    for i in np.flatnonzero(held):
        mine = kept & ((s.i == i) | (~s.on_wall & (s.j == i)))
        turned, rolls = (s.kt[mine] > 0).any(), ((s.kr[mine] > 0) | (s.ktw[mine] > 0)).any()
        turns = (1 if s.dim == 2 else 3) if turned or rolls else 0
        unknowns += s.dim + turns - (turns == 3 and count[i] == 2 and not rolls)
    return max(int(unknowns - springs), 0)


def wall_columns(s):
    on_wall = s.on_wall & s.touching
    translation = 0.5 * (s.mass * (s.v**2).sum(1)).sum()
    out = {"n_wall_contacts": Same(int(on_wall.sum())), "z_wall": Close((2 * s.counted.sum() + on_wall.sum()) / s.n),
           "kinetic_over_elastic": Close(translation / s.energy().sum()), "n_mechanisms": Same(least_mechanisms(s))}
    pressure = s.wall_pressure()
    middle = np.array([np.mean(s.walls["position"][s.walls["axis"] == a]) if a in pressure else 0.0 for a in range(s.dim)])
    friction = (s.shear * (s.x[s.i] - middle))[s.on_wall].sum(0) / s.volume
    for a in range(s.dim):
        out[f"p_wall_{a + 1}"] = Close(pressure.get(a))
        out[f"p_friction_{a + 1}"] = Close(friction[a] if a in pressure else None, pressure.get(a, 0.0))
    return out


def rigid_columns(s):
    path = s.path_attributes
    pairs = {(i, j, *image) for i, j, image in zip(s.i, s.j, s.image.tolist())}
    return {"z_pairs": Close(2 * len(pairs) / s.n), "n_sweeps": Same(int(path["n_sweeps"])),
            "n_unfinished": Same(int(path["n_unfinished"])), "deepest_overlap": Close(path["deepest_overlap"]),
            "force_freedom": Same(None) if s.motion else Close(force_freedom(s), 1.0, 1e-7),
            "inertial_number": Same(s.motion["inertial_number"] if s.motion else None),
            "step_residual": Same(s.motion["residual"] if s.motion else None)}


def columns(s, first, before):
    P = s.target.mean()
    zero = s.tolerances[0] * s.F1(P)
    N = s.N[s.counted]
    plus, minus = (N > zero).sum(), (N < -zero).sum()
    path = s.path_attributes
    out = {"step": Same(int(path["step"])), "branch": Same(path["branch"]), "P_star": Close(s.reduced(P)), "P": Close(P),
           "phi": Close(s.phi), "void_ratio": Close(1 / s.phi - 1), "z": Close(2 * len(N) / s.n),
           "z_plus": Close(2 * plus / s.n), "z_minus": Close(2 * minus / s.n),
           "z_zero": Close(2 * (len(N) - plus - minus) / s.n), "n_contacts": Same(len(N)),
           "n_distant": Same(int((s.distant & ~s.on_wall).sum())), "x0": Close(s.rattlers(zero).sum() / s.n),
           **residual_columns(s), "n_negative": n_negative(s), "time": Close(path["time"]),
           "n_steps": Same(int(path["n_steps"])), "seconds": Exempt("a time"),
           "state": Holds("the name of the file", lambda v: s.path.endswith("/" + v)), "ending": Same(path["ending"])}
    out |= {f"L{a + 1}": Close(s.cell[a, a]) for a in range(s.dim)}
    out |= axes_columns(s, first, before)
    driven = s.on_driven_axis(s.target)
    out |= {"P_driven": Close(driven), "P_driven_star": Close(s.reduced(driven))}
    return out | (wall_columns(s) if s.walls else {}) | (rigid_columns(s) if s.rigid else {})


def check(program, states, tally):
    for kind, samples in states.items():
        table = program.table(f"{kind}/path.csv")
        for k, s in enumerate(samples):
            row = {name: values[k] for name, values in table.items()}
            tally.row("path.csv", s.path, row, columns(s, samples[0], samples[k - 1]))
