"""The columns of floc moduli and of its increments, from a dense stiffness matrix."""
import math

import numpy as np

from graphs import dead_end_contacts, scalar_backbone, structural_parts
from checks import Close, Exempt, Holds, Same
from stiffness import ZERO, Network


def term(square, stiffness):
    """Returns square/stiffness, or 0 if the force is zero."""
    return np.where(square == 0, 0.0, square / np.where(square == 0, 1.0, stiffness))


def complementary(s, kr):
    return (term(s.N**2, s.kn) + term((s.shear**2).sum(1), s.kt) + term((s.rolling**2).sum(1), kr)
            + term(s.twisting**2, s.ktw))


def entries(C, full):
    """Returns the entries of C by the names of their columns. Shear entries exist only with full strains."""
    n = len(C)
    return {f"C{a + 1}{b + 1}": C[a, b] for a in range(n) for b in range(a, n)}


def constants(C, dim):
    """Returns B, B_S and G, computed from the block of normal strains."""
    block = C[:dim, :dim]
    S = np.linalg.pinv(block, rcond=1e-9)
    G = ((dim - 1) * np.trace(block) - (block.sum() - np.trace(block))) / (2 * dim * (dim - 1))
    return block.mean(), 1 / S.sum(), G


class Step:
    """Response of the contacts to an isotropic or deviatoric stress of 1."""

    def __init__(self, net, deviatoric):
        s = net.state
        stress = np.ones(s.dim)
        if deviatoric:
            stress[1:] = -1 / (s.dim - 1)
        C, motion = net.relaxed()
        values, vectors = np.linalg.eigh(C)
        zero = np.abs(values) <= 1e-9 * np.abs(values).max()
        self.solvable = not (np.abs(vectors[:, zero].T @ stress) > 1e-6).any()
        if not self.solvable:
            return
        strain = np.linalg.pinv(C, rcond=1e-9) @ stress
        u = motion @ strain
        m = len(s.i)
        self.normal, self.energy = np.zeros(m), np.zeros(m)
        self.shear = np.zeros((m, s.dim))
        self.rolling, self.twisting = np.zeros((m, net.turns)), np.zeros(m)
        size = np.zeros(m)
        for k, (G, stiffness, tangents, _) in zip(net.k, net.assembled()):
            change = G @ u
            f = stiffness * change
            d = s.dim
            self.normal[k] = f[0]
            self.shear[k] = tangents.T @ f[1:d]
            if d == 2:
                self.rolling[k] = f[2]
            else:
                self.twisting[k] = f[3]
                self.rolling[k] = tangents.T @ f[4:]
            self.energy[k] = 0.5 * f @ change
            moments = (self.rolling[k]**2).sum() + self.twisting[k]**2
            size[k] = math.sqrt(f[:d] @ f[:d] + moments / s.radius[s.i[k]]**2)
        self.carries = size > 1e-9 * size.max()
        touching = s.touching[net.k]
        total = self.energy[net.k][touching].sum()
        order = net.k[np.argsort(-self.energy[net.k], kind="stable")]
        held = np.cumsum(self.energy[order])
        self.n_holding = int(np.searchsorted(held, 0.95 * total * (1 - 1e-12))) + 1
        self.share = self.n_holding / touching.sum()
        self.in_95 = np.zeros(m, bool)
        self.in_95[order[:self.n_holding]] = True


def mean_field(s, net):
    """Returns mean-field estimates from mean sizes of all grains and means over the touching contacts."""
    t = net.k[s.touching[net.k]]
    d = 2 * s.radius
    squares = net_complementary(s, net)[s.touching[net.k]]
    ratio = s.kt[t].sum() / s.kn[t].sum()
    z = 2 * s.counted.sum() / s.n
    density = z * s.phi / 2 / s.ball.mean() / s.dim**2
    out = {}
    branch2 = ((d**2).mean() + d.mean()**2) / 2
    N = s.N[t]
    Z2 = (s.kn[t] * squares).mean() / N.mean()**2
    B = density * s.kn[t].mean() * branch2
    shear = (lambda q: (1 + q) / 2) if s.dim == 2 else (lambda q: 0.6 * (1 + 1.5 * q))
    out["Z2"] = Z2
    out["B_voigt_printed"] = B
    out["G_voigt_printed"] = shear(ratio) * B
    out["G_voigt_smooth_mean_field"] = shear(0) * B
    out["B_reuss_printed"] = density * s.kn[t].mean() * d.mean()**2 / Z2
    out["B_reuss_mean_field"] = density * d.mean()**2 * N.mean()**2 / squares.mean()
    pressed = t[s.N[t] > 0]
    N = s.N[pressed]
    T = (s.shear[pressed]**2).sum(1)
    out["Z_hat"] = (N**(5 / 3) * (1 + term(T * s.kn[pressed], s.kt[pressed]) / N**2)).mean() / N.mean()**(5 / 3)
    return out


def net_complementary(s, net):
    kr = s.kr.copy()
    kr[net.k] = net.kr
    return complementary(s, kr)[net.k]


def voigt(net):
    """Returns the Voigt bounds, from the stiffness for affine displacements divided by the volume."""
    m, n = net.n_grain_unknowns(), net.n_strains()
    affine = net.K()[m:m + n, m:m + n] / net.state.volume
    B, _, G = constants(affine, net.state.dim)
    return B, G


def bounds_hold(net, prestress, B_reuss):
    """Returns whether B_reuss <= B <= B_voigt is a theorem for this state, and whether B_reuss <= B_S is one."""
    s = net.state
    negative = (np.vstack([s.kn[net.k], s.kt[net.k], net.kr, s.ktw[net.k]]) < 0).any()
    force, _ = s.net()
    balanced = np.linalg.norm(force, axis=1).max() < 1e-3 * s.F1(s.target.mean())
    of_B = bool(not negative and not s.distant[net.k].any() and balanced and not prestress)
    # B_S keeps shear strains at zero, also with --strains full, so shear stresses may have any value. Only the normal
    # stresses have to be equal.
    normal = np.diag(s.load_stress)
    largest = np.abs(normal - normal.mean()).max()
    return of_B, of_B and bool(B_reuss == 0 or largest <= 1e-4 * abs(np.trace(s.load_stress)) / s.dim)


def near_mechanisms(net):
    s = net.state
    inner = net.k[~s.on_wall[net.k]]
    bound = np.abs(s.N[inner] / s.length[inner]).max()
    values, _ = net.modes()
    return int(((values > ZERO * values.max()) & (values < bound)).sum())


def rounding_floor(s):
    """Returns the net force that rounding of the positions and of the forces can cause."""
    half = 0.5 * np.finfo(float).eps
    k = np.maximum(np.abs(s.kn), s.kt)
    stiffness = np.bincount(s.i, k, s.n) + np.bincount(s.j[~s.on_wall], k[~s.on_wall], s.n)
    resolution = half * np.abs(s.cell).max() * (half if s.x_low is not None else 1)
    return (stiffness.max() * resolution + half * np.abs(s.N).max()) / s.F1(s.target.mean())


def budget(s, net, step, B, error_B):
    P = s.target.mean()
    F1, _ = s.own_scales(P)
    force, _ = s.net()
    residual = (np.linalg.norm(force, axis=1) / F1).max()
    floor = rounding_floor(s)
    undecided = net.k[s.touching[net.k] & (s.elastic[net.k] <= max(residual, floor) * s.F1(P))]
    held = None
    if step.solvable:
        held = np.abs(step.energy[undecided]).sum() / step.energy.sum() * abs(B) if step.energy.sum() > 0 else None
    return residual, floor, len(undecided), held


def columns(s, row, options, context):
    """Returns the expected value of each column of a row. @param context  {"modes": numbers of motions from floc
    modes}"""
    full = options.get("strains") == "full"
    prestress = options.get("prestress", False)
    kr = options.get("rolling_stiffness")
    net = Network(s, rolling_stiffness=kr)
    plain, _ = net.relaxed(full)
    C, _ = net.relaxed(full, prestress)
    B, B_S, G = constants(C, s.dim)
    size = np.abs(C).max()
    unloaded = not s.target.any()
    load_P = 0.0 if unloaded else np.trace(s.load_stress) / s.dim
    touching = net.k[s.touching[net.k]]
    B_voigt, G_voigt = voigt(net)
    squares = net_complementary(s, net)[s.touching[net.k]].sum()
    iso, dev = Step(net, False), Step(net, True)
    dead = net.dead_ends()
    backbone = [step.carries[net.k] for step in (iso, dev) if step.solvable]
    out = {"file": Same(s.path), "dimension": Same(s.dim), "n_grains": Same(s.n), "units": Same(s.units),
           "n_contacts": Same(int(s.counted.sum())), "n_distant": Same(int((s.distant & ~s.on_wall).sum())),
           "P": Close(s.P, s.stress_scale), "P_star": Close(s.reduced(s.P), s.reduced(s.stress_scale)), **s.driven_columns(), "kn_named": Same(None),
           "kt_named": Same(None), "stiffness_per": Same(None),
           "p_wall": Close(s.p_wall), "phi": Close(s.phi), "z": Close(2 * s.counted.sum() / s.n),
           "method": Same("factor"), "seconds": Exempt("a time"), "seconds_row": Exempt("a time")}
    for name, value in entries(C, full).items():
        out[name] = Close(value, size)
    out |= {"B": Close(B, size), "B_S": Close(B_S, size), "G": Close(G, size)}
    diagonal = np.diag(C)[:s.dim]
    out["isotropy_defect"] = Close(np.ptp(diagonal) / diagonal.mean(), 1.0)
    out |= {"B_voigt": Close(B_voigt), "G_voigt": Close(G_voigt),
            "B_reuss": Close(s.volume * load_P**2 / squares if squares > 0 else 0.0)}
    out |= {name: Close(value) for name, value in mean_field(s, net).items()}
    of_B, of_B_S = bounds_hold(net, prestress, out["B_reuss"].expected)
    out |= {"bounds_hold": Same(of_B), "bounds_hold_B_S": Same(of_B_S), "seconds_row": Exempt("a time")}
    values = net.spectrum(full)
    n_zero, n_negative = int((np.abs(values) <= ZERO).sum()), int((values < -ZERO).sum())
    if prestress:
        out["n_negative"] = out["n_mechanisms"] = out["n_coupled_mechanisms"] = Exempt("with prestress: see the plain row")
    else:
        kinds = structural_parts(net, dead, context["modes"]) if kr is None else None
        vanishing = int((np.abs(np.linalg.eigvalsh(plain)) <= 1e-9 * size).sum())
        out["n_negative"] = Same(n_negative)
        out["n_coupled_mechanisms"] = Same(vanishing)
        # Motions that need no energy, but are not free because of the connections of the grains.
        out["n_mechanisms"] = Same(n_zero - kinds) if kinds is not None else Exempt("see the plain row")
    out["residual"] = Holds("below 1e-12", lambda v: 0 <= v < 1e-12)
    out["condition"] = condition(net)
    out["n_rattlers"] = Same(net.n_rattlers)
    out["x0"] = Close(net.n_rattlers / s.n)
    out["n_free_rollers"] = Same(free_rollers(net, dead))
    out["n_at_cap"] = Same(s.n_yielding)
    for name, of in (("error_B", "B"), ("error_B_S", "B_S"), ("error_G", "G")):
        out[name] = Holds("more than the difference from the dense solution, and small",
                          lambda v, of=of: abs(row[of] - {"B": B, "B_S": B_S, "G": G}[of]) - 1e-9 * size <= v < 1e-8 * size)
    out["error_C"] = Holds("small", lambda v: 0 < v < 1e-8 * size)
    out["n_dead_ends"] = Same(int(dead.sum()))
    parts, directions = components(net, dead)
    out["n_components"], out["n_percolating"] = Same(parts), Same(directions)
    near = near_mechanisms(net)
    out["n_near_mechanisms"] = Same(near)
    with_B, _, with_G = constants(net.relaxed(full, True)[0], s.dim)
    given = near > 0 or prestress
    out["B_prestress"] = Close(with_B if given else None, size)
    out["G_prestress"] = Close(with_G if given else None, size)
    plain_B, _, plain_G = constants(plain, s.dim)
    out["B_without_prestress"], out["G_without_prestress"] = Close(plain_B, size), Close(plain_G, size)
    held = s.n - net.n_rattlers
    between = (~s.on_wall[touching]).sum()
    out["z_star"] = Close(2 * between / held)
    K_N = s.kn[touching].mean()
    out["G_star"] = Close(G * s.a**(s.dim - 2) / (K_N * s.phi * (1 - net.n_rattlers / s.n)), size / K_N)
    out["indeterminacy"] = Same(indeterminacy(net))
    out["energy_share_95"] = Close(iso.share if iso.solvable else None)
    out["energy_share_95_deviatoric"] = Close(dev.share if dev.solvable else None)
    out["backbone_share"] = Close(np.logical_or.reduce(backbone).mean() if backbone else None)
    out["scalar_backbone_share"] = Close(scalar_backbone(net).mean())
    residual, floor, n_undecided, at_stake = budget(s, net, iso, B, row["error_B"])
    out["rounding_floor"], out["residual_force"] = Close(floor), Close(residual, 1e-6)
    out["n_undecided"] = Same(n_undecided)
    out["error_B_equilibrium"] = Close(at_stake, 1e-3 * size)
    sampling = np.ptp(diagonal) / s.dim**2
    out["error_B_sampling"] = Close(sampling, size)
    errors = {"solver": row["error_B"], "sampling": sampling, "rounding" if floor > residual else "residual": at_stake or 0}
    out["limited_by"] = Same(max(errors, key=errors.get))
    out["rolling_stiffness"] = Close(kr)
    n_shear = len(C) - s.dim
    out["G_shear"] = Close(np.diag(C)[s.dim:].mean() if n_shear else None, size)
    singular = (np.abs(np.linalg.eigvalsh(C)) <= 1e-9 * size).any()
    S = None if singular else np.linalg.inv(C)
    for a in range(s.dim):
        out[f"E_{a + 1}"] = Close(None if singular else 1 / S[a, a], size)
        for b in range(s.dim):
            if b != a:
                out[f"nu_{a + 1}{b + 1}"] = Close(None if singular else -S[b, a] / S[a, a], 1.0)
    return out


def condition(net):
    """Estimates the 1-norm condition number from below, usually within a factor of 3, for unknowns with one scale."""
    values, _ = net.modes()
    regular = np.abs(values)[np.abs(values) > ZERO * values.max()]
    ratio = regular.max() / regular.min()
    n = len(values)
    return Holds(f"of the order of {ratio:.3g}", lambda v: v is not None and ratio / 30 < v < 30 * n**0.5 * ratio)


def components(net, dead):
    """Returns the number of connected parts without dead ends and single grains, and the largest number of directions
    in which a part percolates."""
    from state import parts_of
    s = net.state
    held = net.connected & ~dead
    core = [(i, j, image) for i, j, image in net.edges() if held[i] and held[j]]
    joined = set().union(*[{i, j} for i, j, _ in core]) if core else set()
    on_walls = {s.i[k] for k in net.k if s.on_wall[k] and held[s.i[k]]}
    n_parts = sum(1 for grains, _, _ in parts_of(s.n, core) if (joined | on_walls) & set(grains))
    return n_parts, max((n for _, n, _ in parts_of(s.n, net.edges())), default=0)


def free_rollers(net, dead):
    """Counts the dead ends whose contact has no spring against some motion."""
    s = net.state
    count = 0
    active, gone = np.ones(len(net.k), bool), np.zeros(s.n, bool)
    changed = True
    while changed:
        changed = False
        for grain in np.flatnonzero(dead & ~gone):
            mine = np.flatnonzero(active & ((s.i[net.k] == grain) | (s.j[net.k] == grain)))
            if len(mine) != 1:
                continue
            k = net.k[mine[0]]
            springs = [s.kn[k], s.kt[k], net.kr[mine[0]]] + ([s.ktw[k]] if s.dim == 3 else [])
            count += 0.0 in springs
            active[mine], gone[grain], changed = False, True, True
    return count


def indeterminacy(net):
    """Returns the number of independent self-stresses: the number of force components minus the rank of the rigidity
    matrix."""
    rows = [G[stiffness != 0] for G, stiffness, _, _ in net.assembled()]
    if not rows:
        return 0
    R = np.vstack(rows)
    R = R / np.linalg.norm(R, axis=1).max()
    m = net.n_grain_unknowns()
    R[:, m:] *= 1 / net.state.volume**(1 / net.state.dim)
    return len(R) - np.linalg.matrix_rank(R, tol=1e-10 * np.linalg.norm(R, 2))


def increments(s, table, options):
    """Returns the expected columns of --increments, each as an array over the contacts of the state."""
    net = Network(s)
    inside = np.zeros(len(s.i), bool)
    inside[net.k] = True
    m = len(s.i)
    out = {"file": Same([s.path] * m), "contact": Same(list(range(m))), "id1": Same(s.i.tolist()), "id2": Same(s.j.tolist()),
           "distant": Same(s.distant.tolist())}
    for a in range(s.dim):
        out[f"image{a + 1}"] = Same(s.image[:, a].tolist())
    backbone = np.zeros(m, bool)
    any_step = False
    for name, deviatoric in (("isotropic", False), ("deviatoric", True)):
        step = Step(net, deviatoric)
        columns = ["normal", "energy", *(f"shear{a + 1}" for a in range(s.dim)), "rank", "in_95"]
        columns += ["rolling"] if s.dim == 2 else ["rolling1", "rolling2", "rolling3", "twisting"]
        if not step.solvable:
            out |= {f"{name}_{column}": Same([None] * m) for column in columns}
            continue
        any_step = True
        backbone |= step.carries
        scale = max(np.abs(step.normal).max(), np.abs(step.shear).max())
        out[f"{name}_normal"] = Close(step.normal, scale)
        for a in range(s.dim):
            out[f"{name}_shear{a + 1}"] = Close(step.shear[:, a], scale)
        moment = scale * s.a
        if s.dim == 2:
            out[f"{name}_rolling"] = Close(step.rolling[:, 0], moment)
        else:
            for a in range(3):
                out[f"{name}_rolling{a + 1}"] = Close(step.rolling[:, a], moment)
            out[f"{name}_twisting"] = Close(step.twisting, moment)
        energy = step.energy
        out[f"{name}_energy"] = Close(energy, np.abs(energy).max())
        rank = np.array([0 if r is None else r for r in table[f"{name}_rank"]])
        out[f"{name}_rank"] = Holds("1, 2, ... of the contacts by falling energy", lambda _, rank=rank, energy=energy: (
            sorted(rank[inside]) == list(range(1, inside.sum() + 1))
            and (np.diff(energy[inside][np.argsort(rank[inside])]) <= 1e-9 * np.abs(energy).max()).all()
            and not rank[~inside].any()))
        out[f"{name}_in_95"] = Holds("those of the ranks that hold 95 %", lambda flags, rank=rank, n=step.n_holding: (
            [bool(f) for f in flags] == [0 < r <= n for r in rank]))
    ends = np.ones(m, bool)
    ends[net.k] = dead_end_contacts(net)
    scalar = np.zeros(m, bool)
    scalar[net.k] = scalar_backbone(net)
    out["dead_end"] = Same(ends.tolist())
    out["backbone"] = Same(backbone.tolist() if any_step else [None] * m)
    out["scalar_backbone"] = Same(scalar.tolist())
    return out


def modes(s, rows):
    """Compares the rows of floc modes: number of free motions, mechanisms that couple to strain, and each mode."""
    net = Network(s)
    values, vectors = net.modes()
    zero = np.abs(values) <= ZERO * values.max()
    m, dim, n = net.n_grain_unknowns(), s.dim, net.n_strains()
    strain_rows = net.K()[m:m + n, :m]
    geometric = net.K(prestress=True)[:m, :m] - net.K()[:m, :m]
    inner = net.k[~s.on_wall[net.k]]
    near = np.abs(s.N[inner] / s.length[inner]).max()
    n_connected = int(net.connected.sum())
    soft = values[~zero]
    soft_vectors = vectors[:, ~zero]
    out, number = [], 0
    free = {"rattler": net.dofs * net.n_rattlers}
    total = sum(row["count"] for row in rows if row["kind"] in ("translation", "rotation", "roll", "spin"))
    n_mechanisms = sum(row["kind"] == "mechanism" for row in rows)
    for row in rows:
        kind = row["kind"]
        here = {"file": Same(s.path), "kind": Holds("a kind", lambda v: v in KINDS), "count": Same(1)}
        empty = ("eigenvalue", "eigenvalue_prestress", "participation", "softens_B", "softens_G", "grains",
                 *(f"{name}{a + 1}" for name in ("coupling", "strain") for a in range(dim)))
        here |= {name: Same(None) for name in empty}
        if kind in ("rattler", "translation", "rotation", "roll", "spin"):
            here["count"] = Same(free["rattler"]) if kind == "rattler" else Holds(
                f"in all {int(zero.sum())} motions at no cost", lambda _: total + n_mechanisms == zero.sum())
        elif kind == "strain mechanism":
            here["eigenvalue"] = Same(0.0)
            C, _ = net.relaxed()
            strain = np.array([row[f"strain{a + 1}"] for a in range(dim)])
            size = np.abs(net.K()[m:m + n, m:m + n]).max() / s.volume
            for a in range(dim):
                here[f"strain{a + 1}"] = Holds("a strain at no cost", lambda _, x=strain: np.linalg.norm(C @ x) < 1e-8 * size
                                               and abs(np.linalg.norm(x) - 1) < 1e-8)
        elif kind != "mechanism":
            value, vector = soft[number], soft_vectors[:, number]
            number += 1
            alone = all(abs(value - other) > 1e-6 * abs(value) for other in np.delete(soft, number - 1))
            expected = "unstable" if value < 0 else "near-mechanism" if value < near else "elastic"
            here["kind"], here["eigenvalue"] = Same(expected), Close(value, soft.max() * 1e-3)
            if not alone:
                here |= {name: Exempt("of two eigenvalues that are nearly one") for name in empty[1:]
                         if not name.startswith("strain")}
            else:
                here |= of_mode(s, net, row, vector, value, strain_rows @ vector, geometric, n_connected)
        out.append(here)
    return out


KINDS = {"rattler", "translation", "rotation", "roll", "spin", "strain mechanism", "unstable", "mechanism",
         "near-mechanism", "elastic"}


def of_mode(s, net, row, vector, value, coupling, geometric, n_connected):
    """Returns the expected columns of one mode. Its amplitude has length 1 and an arbitrary sign."""
    dim = s.dim
    square = (vector.reshape(s.n, -1)**2).sum(1)
    softening = np.outer(coupling, coupling) / (value * s.volume)
    B, _, G = constants(softening, dim)
    sign = np.sign(coupling @ np.array([row[f"coupling{a + 1}"] for a in range(dim)])) or 1.0
    scale = np.abs(net.K()).max() * s.a * 1e-2
    here = {"eigenvalue_prestress": Close(value + vector @ geometric @ vector, np.abs(geometric).max()),
            "participation": Close(square.sum()**2 / (n_connected * (square**2).sum()), 1.0),
            "softens_B": Close(B, abs(B) + 1e-3 * abs(softening).max()), "softens_G": Close(G, abs(softening).max())}
    for a in range(dim):
        here[f"coupling{a + 1}"] = Close(sign * coupling[a], scale)
    named = [int(grain) for grain in str(row["grains"]).split()]
    # At most 12 grains are named.
    here["grains"] = Holds("the fewest that hold half", lambda _: (
        (square[named].sum() >= 0.5 - 1e-9 or len(named) == 12)
        and square[named[:-1]].sum() < 0.5 + 1e-9
        and square[named].min() >= np.delete(square, named).max() - 1e-9))
    return here


TABLES = {"moduli": "floc moduli", "moduli --increments": "--increments", "modes": "floc modes"}
OPTIONS = ({}, {"strains": "full"}, {"prestress": True}, {"rolling_stiffness": 0.5})
WORDS = {"strains": "--strains", "rolling_stiffness": "--rolling-stiffness"}


def check(program, states, tally):
    for kind, samples in states.items():
        for s in samples:
            if s.rigid:
                continue  # contacts without a stiffness: floc refuses them
            counts = None
            if not s.walls:
                rows = program.rows("modes", s.path)
                counts = {row["kind"]: row["count"] for row in rows
                          if row["kind"] in ("rattler", "translation", "rotation", "roll", "spin")}
                for row, expected in zip(rows, modes(s, rows)):
                    tally.row("modes", s.path, row, expected)
            for options in OPTIONS:
                if s.walls and options.get("strains"):
                    continue  # walls shear no grains
                arguments = []
                for name, value in options.items():
                    arguments += ["--prestress"] if name == "prestress" else [WORDS[name], value]
                row = program.rows("moduli", s.path, *arguments, "--increments", "increments.csv")[0]
                tally.row("moduli", s.path, row, columns(s, row, options, {"modes": counts}))
                if not options:
                    table = program.table("increments.csv")
                    tally.row("moduli --increments", s.path, table, increments(s, table, options))
