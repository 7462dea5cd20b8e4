"""The columns of floc network and of the files it writes."""
import math

import numpy as np

from checks import Close, Exempt, Holds, Same
from moduli import Step, indeterminacy
from rigid import indeterminacy as rigid_indeterminacy
from state import parts_of
from stiffness import Network

SHUFFLES = 400


def pearson(x, y):
    x, y = x - x.mean(), y - y.mean()
    return x @ y / math.sqrt(x @ x * (y @ y))


def mobilisation(s, of, mean):
    """Returns the mean of F_T/N over contacts with N above its mean, and over those below. Contacts with N <= 0 are
    left out."""
    of = of[s.elastic[of] > 0]
    ratio = np.linalg.norm(s.shear[of], axis=1) / s.elastic[of]
    sides = (ratio[s.elastic[of] > mean], ratio[s.elastic[of] <= mean])
    return [side.mean() if len(side) else 0.0 for side in sides]


def bonds(s):
    """Returns (i, j, image) of all interactions between two grains."""
    return [(s.i[k], s.j[k], s.image[k]) for k in np.flatnonzero(~s.on_wall)]


def phase(s, sign, value):
    """Returns for the grains of one sign: sizes of their clusters, largest number of directions in which a cluster
    percolates, and the lattice vectors along which one does."""
    edges = [(i, j, image) for i, j, image in bonds(s) if sign[i] == value and sign[j] == value]
    sizes, most, along = [], 0, np.zeros(s.dim, bool)
    for grains, rank, loops in parts_of(s.n, edges):
        if sign[grains[0]] != value:
            continue
        sizes.append(len(grains))
        most = max(most, rank)
        for loop in loops:
            along |= loop != 0
    return sorted(sizes, reverse=True), most, along


def pressures(s):
    return np.trace(s.particle_stress(), axis1=1, axis2=2) / s.dim


def phase_columns(s, p, zero):
    """Returns the columns pressed_* and pulled_*, for grains of positive and of negative pressure."""
    out = {}
    sign = signs_beyond_zero(s, p, np.zeros(s.n, bool), zero)
    for name, value in (("pressed", 1), ("pulled", -1)):
        sizes, most, _ = phase(s, sign, value)
        mine = p[sign == value]
        out |= {f"{name}_share": Close(len(mine) / s.n), f"{name}_mean": Close(mine.mean() if len(mine) else 0.0),
                f"{name}_largest": Same(sizes[0] if sizes else 0), f"{name}_percolates": Same(most)}
    return out


def like(s, sign):
    pairs = [(sign[i], sign[j]) for i, j, _ in bonds(s) if i != j and sign[i] and sign[j]]
    return len(pairs), np.mean([a == b for a, b in pairs]) if pairs else 0.0


def signs_beyond_zero(s, p, rattler, zero):
    """Returns the signs of the pressures. Pressures up to zero/a^(d-1) and rattlers have the sign 0."""
    sign = np.sign(p).astype(int)
    sign[rattler | (np.abs(p) <= zero / s.a**(s.dim - 1))] = 0
    return sign


def with_phases(s, p, rattler, zero):
    """Returns the expected columns of --with phases. Columns that depend on random permutations are compared with
    other permutations."""
    sign = signs_beyond_zero(s, p, rattler, zero)
    n_bonds, share = like(s, sign)
    n, plus = int((sign != 0).sum()), int((sign == 1).sum())
    expected = (plus * (plus - 1) + (n - plus) * (n - plus - 1)) / (n * (n - 1)) if n > 1 else 0.0
    random = np.random.default_rng(7)
    shares, found = [], {1: [], -1: []}
    for _ in range(SHUFFLES):
        shuffled = sign.copy()
        shuffled[sign != 0] = random.permutation(sign[sign != 0])
        shares.append(like(s, shuffled)[1])
        for value in found:
            sizes, most, _ = phase(s, shuffled, value)
            found[value].append((sizes[0] if sizes else 0, most, most > 0))

    def near(values):
        """Requires a value within five standard errors of the difference of two means of equally many draws."""
        mean, deviation = np.mean(values), np.std(values)
        return Holds(f"about {mean:.4g}", lambda v: abs(v - mean) <= 7.1 * deviation / math.sqrt(SHUFFLES) + 1e-9
                     + 20.0 / SHUFFLES)

    spread = math.sqrt(np.mean((np.array(shares) - expected)**2)) if n_bonds else 0.0
    d = 2 * s.radius
    out = {"p0": Close(s.F0 / d.mean()**(s.dim - 1) if s.F0 > 0 else s.P), "n_signed_bonds": Same(n_bonds),
           "like_share": Close(share), "like_share_shuffled": Close(expected),
           "like_share_shuffled_stddev": Holds(f"about {spread:.4g}", lambda v: abs(v - spread) <= 0.3 * spread + 1e-12)}
    for name, value in (("positive", 1), ("negative", -1)):
        sizes, most, along = phase(s, sign, value)
        out |= {f"{name}_along": Same("".join("xyz"[a] for a in np.flatnonzero(along)) or "none"),
                f"{name}_clusters": Same(len(sizes)), f"{name}_largest_cluster": Same(sizes[0] if sizes else 0),
                f"{name}_directions": Same(most)}
        largest, directions, percolates = zip(*found[value])
        out |= {f"{name}_largest_cluster_shuffled": near(largest), f"{name}_directions_shuffled": near(directions),
                f"{name}_percolates_shuffled": near(percolates)}
    return out


def with_bonds(s):
    N = s.N[~s.on_wall]
    near = (np.abs(N) < 0.02 * s.F0) | (N == 0)
    plus, minus = N[~near & (N > 0)], -N[~near & (N < 0)]
    d = 2 * s.radius.mean()
    sized = s.phi * s.F0 / (np.pi * d**(s.dim - 1))
    z = 2 * len(N) / s.n
    return {"n_bonds": Same(len(N)), "z_bonds": Close(z), "z_bonds_plus": Close(2 * len(plus) / s.n),
            "z_bonds_minus": Close(2 * len(minus) / s.n), "z_bonds_near_zero": Close(2 * near.sum() / s.n),
            "minus_share": Close(len(minus) / (len(plus) + len(minus)) if len(plus) + len(minus) else 0.0),
            "mean_plus": Close(plus.mean() if len(plus) else 0.0),
            "mean_minus": Close(minus.mean() if len(minus) else 0.0), "virial_strength": Close(z * sized),
            "rumpf_strength": Close(np.pi / (1 - s.phi) * sized)}


def p_max(s):
    """Returns the largest pressure inside a contact, if all contacts follow Hertz's law."""
    if s.law["normal"] != "hertz":
        return None
    pressed = s.touching & (s.elastic > 0)
    with np.errstate(divide="ignore"):
        R = 1 / (1 / s.radius[s.i] + np.where(s.on_wall, 0.0, 1 / np.where(s.on_wall, 1.0, s.radius_j)))
    return (1.5 * s.elastic / (np.pi * R * -s.c["gap"]))[pressed].max()


def counted_columns(s, zero):
    N, counted = s.N, s.counted
    n_touching = counted.sum()
    rattler = s.rattlers(zero)
    free = rattler[s.i] | rattler[np.where(s.on_wall, 0, s.j)]
    degree = np.bincount(s.i[counted], minlength=s.n) + np.bincount(s.j[counted], minlength=s.n)
    pairs = (degree[s.i[counted]] == 2) & (degree[s.j[counted]] == 2)
    held = s.n - rattler.sum()
    per = 2 / s.n
    plus, minus = (N[counted] > zero).sum(), (N[counted] < -zero).sum()
    out = {"n_contacts": Same(int(n_touching)), "n_distant": Same(int((s.distant & ~s.on_wall).sum())),
           "z": Close(per * n_touching), "z_plus": Close(per * plus), "z_minus": Close(per * minus),
           "z_zero": Close(per * (n_touching - plus - minus)),
           "z_with_distant": Close(per * (~s.on_wall).sum()), "n_rattlers": Same(int(rattler.sum())),
           "x0": Close(rattler.sum() / s.n), "z_star": Close(2 * (counted & ~free).sum() / held),
           "x22": Close(pairs.mean())}
    E = s.elastic[counted]
    out |= {"mean_normal_force": Close(E.mean()), "largest_normal_force": Close(E.max())}
    out |= {f"moment_{q}": Close((E**q).mean() / E.mean()**q) for q in (2, 3, 4)}
    M1, M2 = mobilisation(s, np.flatnonzero(counted), E.mean())
    return out | {"M1": Close(M1), "M2": Close(M2)}


def carrying_columns(s, zero):
    least = 2 if s.shear.any() else s.dim + 1
    kept, outside = s.carrying(zero, least)
    of = np.flatnonzero(kept & ~s.on_wall)
    degree = np.bincount(s.i[of], minlength=s.n) + np.bincount(s.j[of], minlength=s.n)
    x0, x2, z = outside.sum() / s.n, (degree == 2).sum() / s.n, 2 * len(of) / s.n
    z_star = z / (1 - x0)
    out = {"n_carrying": Same(len(of)), "z_carrying": Close(z), "x0_carrying": Close(x0), "x2": Close(x2),
           "z_star_carrying": Close(z_star),
           "z_star_star": Close(z_star + 2 * x2 / (3 * (1 - x0)) if s.dim == 3 else None)}
    N, mean = s.elastic[of], s.elastic[of].mean()
    out |= {name: Close((N**q).mean() / mean**q) for name, q in (("Z_1_3", 1 / 3), ("Z_5_3", 5 / 3), ("Z_2", 2))}
    M1, M2 = mobilisation(s, of, mean)
    out |= {"M1_carrying": Close(M1), "M2_carrying": Close(M2),
            "sliding_share": Close(s.c["sliding"][of].astype(bool).mean())}
    deviation = s.normal[of][:, :, None] * s.normal[of][:, None, :] - np.eye(s.dim) / s.dim
    for name, part in (("fabric", N > -1), ("strong_fabric", N > mean), ("weak_fabric", N <= mean)):
        tensor = deviation[part].sum(0) / len(of)
        for a in range(3):
            for b in range(a, 3):
                out[f"{name}{a + 1}{b + 1}"] = Close(tensor[a, b] if b < s.dim else None, 1.0)
    return out, kept


def likeliest_alpha(x):
    """Returns the exponent alpha of the distribution x^-alpha for x < 1 and exp[beta (1 - x)] beyond, fitted by
    maximum likelihood, and its standard error. Returns None if the data do not determine it."""
    below = x[x < 1]
    if len(x) < 10 or not len(below):
        return None, None

    def slope(alpha):
        beta = math.sqrt((1 - alpha) * (2 - alpha))
        d_beta = (2 * alpha - 3) / (2 * beta)
        d_k = 1 / (1 - alpha)**2 - d_beta / beta**2
        return -len(x) * d_k / (1 / (1 - alpha) + 1 / beta) - np.log(below).sum() - d_beta * (x[x >= 1] - 1).sum()

    low, high = -50.0, 0.999
    if slope(low) < 0 or slope(high) > 0:
        return None, None
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if slope(middle) > 0 else (low, middle)
    return low, 1 / math.sqrt(-(slope(low + 1e-5) - slope(low - 1e-5)) / 2e-5)


def force_shape(forces, suffix):
    x = forces / forces.mean() if len(forces) else forces
    tails = {}
    for bound, name in ((1, "beta"), (2, "beta2")):
        above = x[x >= bound]
        beta = 1 / (above - bound).mean() if len(above) >= 10 else None
        tails |= {f"{name}{suffix}": Close(beta), f"{name}{suffix}_error": Close(beta and beta / math.sqrt(len(above)))}
    alpha, error = likeliest_alpha(x)
    # Both programs maximise a function, which determines the position only to the square root of the rounding error.
    return tails | {f"below_mean{suffix}": Close((x < 1).mean() if len(x) else 0.0),
                    f"alpha{suffix}": Close(alpha, 1.0, 1e-6), f"alpha{suffix}_error": Close(error, 0.0, 1e-3)}


def anisotropy_columns(s, of):
    names = ("a_normals", "a_normal_force", "a_tangential_force", "a_branch_normal", "a_branch_tangential", "stress_ratio",
             "stress_ratio_predicted")
    n, N, T = s.normal[of], s.N[of], -s.shear[of]
    r = s.x[s.j[of]] + s.image[of] @ s.cell - s.x[s.i[of]]
    length = (r * n).sum(1)
    stress = np.einsum("ka,kb->ab", N[:, None] * n + T, r)

    def deviator(m):
        m = (m + m.T) / 2
        return m - np.trace(m) / s.dim * np.eye(s.dim)

    d = deviator(stress)
    size = math.sqrt((d**2).sum())
    if not len(of) or np.trace(stress) <= 0 or size < 1e-4 * np.trace(stress) / s.dim:
        return {name: Same(None) for name in names}
    # In the principal axes of the deviatoric stress, a tensor with the anisotropy a is a diag(1, -1) in 2D and a
    # diag(2, -1, -1) in 3D.
    unit = math.sqrt(2 if s.dim == 2 else 6)

    def along(weights, vectors):
        return (deviator(np.einsum("k,ka,kb->ab", weights, vectors, n)) * d).sum() / size / unit

    ones, two = np.ones(len(of)), s.dim * (s.dim + 2) / 2
    slip = s.dim + 2 if s.dim == 2 else 1.5 * (s.dim + 2)
    a_c = two * along(ones, n) / len(of)
    a = [a_c, two * along(N, n) / N.sum() - a_c, slip * along(ones, T) / N.sum(), two * along(length, n) / length.sum() - a_c,
         slip * along(ones, r - length[:, None] * n) / length.sum()]
    ratio = size / unit * s.dim / np.trace(stress)
    return {name: Close(value, 1.0) for name, value in zip(names, [*a, ratio, sum(a) * (0.5 if s.dim == 2 else 0.4)])}


def moments_of_polygon(v):
    """Returns the integral of x x' over the polygon with these corners, counter-clockwise."""
    return sum(np.cross(p, q) / 24 * (np.outer(p, p) + np.outer(q, q) + np.outer(p + q, p + q))
               for p, q in zip(v, np.roll(v, -1, 0)))


def moments_of_rounded(v, R):
    """Returns the integral of x x' over a polygon or segment that is rounded by R: core, strips on its sides, sectors."""
    total = moments_of_polygon(v)
    sides = np.roll(v, -1, 0) - v
    if R == 0:
        return total
    normals = np.stack([sides[:, 1], -sides[:, 0]], 1) / np.linalg.norm(sides, axis=1)[:, None]
    for p, q, n, before in zip(v, np.roll(v, -1, 0), normals, np.roll(normals, 1, 0)):
        total = total + moments_of_polygon(np.array([p, p + R * n, q + R * n, q]))
        start = np.arctan2(before[1], before[0])
        end = np.arctan2(n[1], n[0])
        end += 2 * np.pi * (end < start)
        turn, waves = end - start, (np.sin(2 * end) - np.sin(2 * start)) / 4
        first = np.array([np.sin(end) - np.sin(start), np.cos(start) - np.cos(end)])
        mixed = (np.sin(end)**2 - np.sin(start)**2) / 2
        second = np.array([[turn / 2 + waves, mixed], [mixed, turn / 2 - waves]])
        total = total + R**2 / 2 * turn * np.outer(p, p) + R**3 / 3 * (np.outer(p, first) + np.outer(first, p)) + R**4 / 4 * second
    return total


def long_axes(s):
    names = ("long_axes_order", "long_axis1", "long_axis2", "long_axis3")
    if not s.shapes:
        return {name: Same(None) for name in names}
    vertices, first = s.shapes["vertices"], s.shapes["first_vertex"]
    axes = []
    for k in range(len(first) - 1):
        v, moments = vertices[first[k]:first[k + 1]], None
        if s.dim == 3:  # in principal axes, for density 1; the samples have no rounded polyhedra
            inertia = s.shapes["inertia"][k]
            moments = np.diag([(inertia.sum() - 2 * i) / 2 for i in inertia])
        else:
            centre = np.arctan2(v[:, 1], v[:, 0])
            v = v[np.argsort(centre)]
            moments = moments_of_rounded(v, s.shapes["rounding"][k])
        values, vectors = np.linalg.eigh(moments)
        axes.append(vectors[:, -1] if values[-1] > 1.05**2 * values[-2] else None)
    e = np.array([s.turn(i) @ axes[k] for i, k in enumerate(s.shape) if axes[k] is not None])
    if not len(e):
        return {name: Same(None) for name in names}
    values, vectors = np.linalg.eigh((s.dim * np.einsum("ka,kb->ab", e, e) / len(e) - np.eye(s.dim)) / (s.dim - 1))
    out = {"long_axes_order": Close(values[-1], 1.0)}
    for a in range(3):
        expected = abs(vectors[a, -1]) if a < s.dim else None
        out[f"long_axis{a + 1}"] = Same(None) if expected is None else Holds(
            f"{expected} of either sign", lambda v, expected=expected: abs(abs(v) - expected) < 1e-7)
    return out


def statistics_columns(s, kept):
    """Returns the columns about kinds of contacts, anisotropies and force distributions of the force-carrying
    structure."""
    of = np.flatnonzero(kept & ~s.on_wall)
    out = force_shape(s.N[of][s.N[of] > 0], "") | anisotropy_columns(s, of) | long_axes(s)
    limit = s.mu * s.elastic[of]
    ratios = np.linalg.norm(s.shear[of], axis=1)[limit > 0] / limit[limit > 0]
    out["mobilisation"] = Close(ratios.mean() if len(ratios) else None)
    kinds = ("vertex_face", "edge_edge", "edge_face", "face_face")
    names = ["below_mean_pairs", "alpha_pairs", "alpha_pairs_error", "beta_pairs", "beta_pairs_error", "beta2_pairs", "beta2_pairs_error",
             "z_pairs_star"]
    if not s.shapes:
        return out | {name: Same(None) for name in [*names, *(f"{p}_{k}" for p in ("pairs", "force") for k in kinds)]}
    pairs = {}
    for k in of:
        pairs.setdefault((s.i[k], s.j[k], *s.image[k].tolist()), []).append(k)
    forces = np.array([s.N[points].sum() for points in pairs.values()])
    number = [(1 if s.c["type"][points[0]] == 1 else 0) if len(points) == 1 else 2 if s.dim == 3 and len(points) == 2 else 3
              for points in pairs.values()]
    held = len(set(s.i[of]) | set(s.j[of]))
    out |= force_shape(forces[forces > 0], "_pairs") | {"z_pairs_star": Close(2 * len(pairs) / held if held else 0.0)}
    for k, kind in enumerate(kinds):
        mine = np.array(number) == k
        out |= {f"pairs_{kind}": Close(mine.mean(), 1.0), f"force_{kind}": Close(forces[mine].sum() / forces.sum(), 1.0)}
    return out


def mechanics_columns(s, kept):
    """Returns the columns that need the elastic response, of the network and of the force-carrying structure."""
    names = ("indeterminacy", "n_dead_ends", "n_components", "n_percolating", "energy_share_95",
             "energy_share_95_deviatoric", "backbone_share", "scalar_backbone_share", "correlation_normal",
             "correlation_size", "hyperstaticity", "n_null_modes")
    if s.walls:
        return {name: Same(None) for name in names}
    if s.rigid:
        return {name: Same(None) for name in names} | {"indeterminacy": Same(rigid_indeterminacy(s, s.tolerances[0] * s.F1(
            s.target.mean())))}
    from moduli import columns as of_moduli
    net = Network(s, s.tolerances[0])
    shared = of_moduli(s, {"error_B": 0.0}, {}, {"modes": None})
    out = {name: shared[name] for name in names[:8]}
    held = Network(s, members=kept)
    out["hyperstaticity"] = Same(indeterminacy(held))
    rank = sum((k != 0).sum() for _, k, _, _ in held.assembled()) - indeterminacy(held)
    out["n_null_modes"] = Same(int(held.dofs * held.connected.sum() + s.dim - rank))
    step = Step(net, False)
    if not step.solvable:
        return out | {"correlation_normal": Same(None), "correlation_size": Same(None)}
    t = net.k[s.touching[net.k]]
    whole = np.hypot(s.N, np.linalg.norm(s.shear, axis=1))[t]
    added = np.hypot(step.normal, np.linalg.norm(step.shear, axis=1))[t]
    return out | {"correlation_normal": Close(pearson(s.N[t], step.normal[t]), 1.0),
                  "correlation_size": Close(pearson(whole, added), 1.0)}


def columns(s):
    zero = s.tolerances[0] * s.F1(s.target.mean())
    p = pressures(s)
    # A force that is only rounding counts neither as tension nor as compression, so that no number may depend on its
    # sign.
    out = {"file": Same(s.path), "dimension": Same(s.dim), "n_grains": Same(s.n), "units": Same(s.units),
           "P": Close(s.P, s.stress_scale), "P_star": Close(s.reduced(s.P), s.reduced(s.stress_scale)), **s.driven_columns(),
           "p_wall": Close(s.p_wall), "n_solid_bonds": Same(0),  # no state of the samples has bonds: cli.Imports counts them
            "phi": Close(s.phi), "seconds": Exempt("a time")}
    out |= counted_columns(s, zero)
    out |= phase_columns(s, p, zero)
    carrying, kept = carrying_columns(s, zero)
    out |= carrying
    out |= statistics_columns(s, kept)
    out |= mechanics_columns(s, kept)
    stress = np.diag(s.stress)
    out |= {"energy_per_grain": Close(s.energy().sum() / s.n), "p_max": Close(p_max(s)),
            "stress_spread": Close(np.ptp(stress), s.stress_scale)}
    out |= with_bonds(s)
    return out | with_phases(s, p, s.rattlers(zero), zero)


def particle_stress(s):
    stress, p = s.particle_stress(), pressures(s)
    size = np.abs(stress).max()
    out = {"file": Same([s.path] * s.n), "grain": Same(list(range(s.n))), "radius": Same(s.radius.tolist()),
           "pressure": Close(p, size)}
    for a in range(s.dim):
        out[f"x{a + 1}"] = Same(s.x[:, a].tolist())
        for b in range(s.dim):
            out[f"stress{a + 1}{b + 1}"] = Close(stress[:, a, b], size)
    return out


def forces_of(s, kind):
    if kind == "normal":
        return s.N[~s.on_wall]
    return np.linalg.norm((s.shear if kind == "tangential" else s.rolling)[s.counted], axis=1)


def histogram_rows(values, low, high):
    """Counts the values in each bin. A value at an edge, up to rounding, may be in either bin."""
    slack = 1e-9 * (high - low)
    at_least = ((values[None] >= low[:, None] + slack[:, None]) & (values[None] < high[:, None] - slack[:, None])).sum(1)
    at_most = ((values[None] >= low[:, None] - slack[:, None]) & (values[None] < high[:, None] + slack[:, None])).sum(1)
    return at_least, at_most


def within(at_least, at_most):
    return Holds("as many values as the bin holds", lambda counts: all(
        low <= count <= high for low, count, high in zip(at_least, counts, at_most)))


def pdf(s, table, unit):
    kinds, n_rows = table["kind"], len(table["kind"])
    low, high, count = (np.array(table[name], float) for name in ("low", "high", "count"))
    given = {"F0": s.F0, "P": s.P * s.a**(s.dim - 1)}
    units, total = np.zeros(n_rows), np.zeros(n_rows, int)
    at_least, at_most = np.zeros(n_rows, int), np.zeros(n_rows, int)
    complete = True
    for kind in dict.fromkeys(kinds):
        rows = np.array([k == kind for k in kinds])
        values = forces_of(s, kind)
        size = np.abs(values).mean() if unit == "mean" else given[unit] * (s.a if kind == "rolling" else 1)
        units[rows], total[rows] = size, len(values)
        at_least[rows], at_most[rows] = histogram_rows(values / size, low[rows], high[rows])
        complete = complete and count[rows].sum() == len(values)
    return {"file": Same([s.path] * n_rows), "kind": Holds("the kinds of forces", lambda v: {"normal"} <= set(v) <= {
        "normal", "tangential", "rolling"}), "unit_force": Close(units), "n": Same(total.tolist()),
            "low": Close(np.round(low / 0.25) * 0.25, 1.0), "high": Close(low + 0.25, 1.0),
            "count": within(at_least, at_most),
            "density": Close(count / total / (high - low)), "n_outside": Same([0] * n_rows)} | ({} if complete else {"count": Holds("all values", lambda _: False)})


def pressure_pdf(s, table):
    p = pressures(s)[~s.rattlers(s.tolerances[0] * s.F1(s.target.mean()))]
    unit = s.F0 / (2 * s.radius).mean()**(s.dim - 1) if s.F0 > 0 else s.P
    low, high, count = (np.array(table[name], float) for name in ("low", "high", "count"))
    return {"file": Same([s.path] * len(low)), "unit_stress": Close(np.full(len(low), unit)),
            "low": Close(np.round(low / 0.25) * 0.25, 1.0), "high": Close(low + 0.25, 1.0),
            "count": within(*histogram_rows(p / unit, low, high)), "n": Same([len(p)] * len(low)),
            "density": Close(count / len(p) / (high - low)), "n_outside": Same([0] * len(low))}


def exponent(windows):
    """Fits b of the density exp(-b x) by maximum likelihood to values in windows, given as (values minus start,
    width). Returns b and its standard error."""
    n = sum(len(x) for x, _ in windows)
    if n < 10:
        return None, None
    total = sum(x.sum() for x, _ in windows)

    def mean_and_variance(b, width):
        if math.isinf(width):
            return 1 / b, 1 / b**2
        t = max(-600.0, min(b * width, 600.0))
        if abs(t) < 1e-4:
            return width * (0.5 - t / 12), width**2 / 12
        return width * (1 / t - 1 / math.expm1(t)), width**2 * (1 / t**2 - 1 / (4 * math.sinh(t / 2)**2))

    # The search ends at a million times the exponent of the tail without an upper end.
    far = 1e6 * n / total
    low, high = (1e-12 * far if any(math.isinf(w) and len(x) for x, w in windows) else -far), far
    for _ in range(200):
        b = (low + high) / 2
        expected = sum(len(x) * mean_and_variance(b, w)[0] for x, w in windows if len(x))
        low, high = (b, high) if expected > total else (low, b)
    return b, 1 / math.sqrt(sum(len(x) * mean_and_variance(b, w)[1] for x, w in windows if len(x)))


def exponents(s, table):
    zero = s.tolerances[0] * s.F1(s.target.mean())
    p = pressures(s)[~s.rattlers(zero)]
    N = forces_of(s, "normal")
    p0 = s.F0 / (2 * s.radius).mean()**(s.dim - 1) if s.F0 > 0 else s.P
    sizes = {("force", "F0"): s.F0, ("force", "mean"): np.abs(N).mean(), ("force", "P"): s.P * s.a**(s.dim - 1),
             ("pressure", "p0"): p0, ("pressure", "mean"): np.abs(p).mean()}
    if not s.target.any():  # P is what rounding leaves of zero
        keep = [unit != "P" for unit in table["unit"]]
        for name in table:
            table[name][:] = [value for value, kept in zip(table[name], keep) if kept]
    n = len(table["file"])
    found = {"unit_size": [], "n": [], "exponent": [], "stderr": []}
    for k in range(n):
        quantity, unit = table["quantity"][k], table["unit"][k]
        size, side, start, end = sizes[quantity, unit], table["side"][k], table["from"][k], table["to"][k]
        values = (N if quantity == "force" else p) / size
        # The largest tension is F0, so each sign has its own end of the axis.
        pull_off = s.F0 / size if quantity == "force" and s.F0 > 0 else math.inf
        ends = {"+": end if end is not None else math.inf, "-": end if end is not None else pull_off}
        windows = []
        for sign, name in ((1, "+"), (-1, "-")):
            if side in (name, "both"):
                stop = ends[name] if side != "both" else (math.inf if sign > 0 else pull_off)
                x = sign * values
                x = x[(x > 0) & (x >= start) & (x <= stop)]
                windows.append((x - start, stop - start))
        b, error = exponent(windows)
        found["unit_size"].append(size)
        found["n"].append(sum(len(x) for x, _ in windows))
        found["exponent"].append(b)
        found["stderr"].append(error)
    thresholds = {("force", "F0"): {0.0, 0.02, 0.1}, ("pressure", "p0"): {0.0, 0.1}}
    return {"file": Same([s.path] * n), "quantity": Holds("known", lambda v: set(v) == {"force", "pressure"}),
            "unit": Holds("known", lambda v: set(v) <= {"F0", "mean", "P", "p0"}), "unit_size": Close(found["unit_size"]),
            "side": Holds("known", lambda v: set(v) <= {"+", "-", "both"}),
            "from": Holds("thresholds", lambda v: all(
                x in thresholds.get((q, u), {0.0, 1.0}) for x, q, u in zip(v, table["quantity"], table["unit"]))),
            "to": Holds("ends beyond them", lambda v: all(x is None or x > y for x, y in zip(v, table["from"]))),
            "n": Same(found["n"]), "exponent": Close(np.array(found["exponent"], object), 0, 1e-6),
            "stderr": Close(np.array(found["stderr"], object), 0, 1e-5)}


def like_neighbours(s, table):
    zero = s.tolerances[0] * s.F1(s.target.mean())
    p = pressures(s)
    sign = signs_beyond_zero(s, p, s.rattlers(zero), zero)
    around = [[] for _ in range(s.n)]
    for i, j, _ in bonds(s):
        if i != j:
            around[i].append(sign[j])
            around[j].append(sign[i])
    expected = []
    for name, value in (("positive", 1), ("negative", -1)):
        bins = {}
        for i in np.flatnonzero(sign == value):
            signed = [other for other in around[i] if other]
            if signed:
                bins.setdefault(min(9, 10 * signed.count(value) // len(signed)), []).append(abs(p[i]))
        for b in sorted(bins):
            sizes = np.array(bins[b])
            expected.append((name, b / 10, (b + 1) / 10, len(sizes), sizes.mean(),
                             sizes.std(ddof=1) / math.sqrt(len(sizes)) if len(sizes) > 1 else None))
    phases, lows, highs, counts, means, errors = zip(*expected)
    return {"file": Same([s.path] * len(phases)), "phase": Same(list(phases)), "like_low": Close(np.array(lows)),
            "like_high": Close(np.array(highs)), "n_grains": Same(list(counts)), "mean_size": Close(np.array(means)),
            "stderr": Close(np.array(errors, object), 1e-2 * np.abs(p).max())}


def clusters(s, table):
    zero = s.tolerances[0] * s.F1(s.target.mean())
    sign = signs_beyond_zero(s, pressures(s), s.rattlers(zero), zero)
    expected = []
    for name, value in (("positive", 1), ("negative", -1)):
        sizes, _, _ = phase(s, sign, value)
        expected += [(name, size, sizes.count(size)) for size in sorted(set(sizes), reverse=True)]
    phases, sizes, counts = zip(*expected)
    return {"file": Same([s.path] * len(phases)), "phase": Same(list(phases)), "n_grains": Same(list(sizes)),
            "count": Same(list(counts))}


TABLES = {"network": "floc network", "network --pdf": "--pdf", "network --particle-stress": "--particle-stress",
          "network --exponents": "--exponents", "network --pressure-pdf": "--pressure-pdf",
          "network --like-neighbours": "--like-neighbours", "network --clusters": "--clusters"}


def check(program, states, tally):
    files = {"--particle-stress": particle_stress, "--exponents": exponents, "--pressure-pdf": pressure_pdf,
             "--like-neighbours": like_neighbours, "--clusters": clusters}
    for samples in states.values():
        for s in samples:
            arguments = [word for option in files for word in (option, option[2:] + ".csv")]
            row = program.rows("network", s.path, "--with", "bonds,phases", "--shuffles", SHUFFLES, *arguments,
                               "--pressure-bin-width", 0.25)[0]
            tally.row("network", s.path, row, columns(s))
            for option, recompute in files.items():
                table = program.table(option[2:] + ".csv")
                if table["file"]:
                    expected = recompute(s) if option == "--particle-stress" else recompute(s, table)
                    tally.row(f"network {option}", s.path, table, expected)
            for unit in ("mean", "F0", "P"):
                if (unit == "F0" and s.F0 == 0) or (unit == "P" and not s.target.any()):
                    continue
                program.run("network", s.path, "--without", "mechanics", "--pdf", "pdf.csv", "--unit", unit, "--bin-width",
                            0.25)
                table = program.table("pdf.csv")
                tally.row("network --pdf", s.path, table, pdf(s, table, unit))
