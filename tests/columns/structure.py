"""The columns of floc structure and of the files it writes, by sums over all pairs and images."""
import itertools
import math

import numpy as np

import voids
from checks import Close, Exempt, Holds, Same
from network import pressures
from pores import find_pores

RANGE = 2.0  # wave numbers that are fitted, in 2 pi over the largest diameter
REACH = 1.5
SIDE = 4  # mesh cells of a map
PROBES, SLICES = 4, 5
CELLS = 24  # of the mesh for a wave length of the largest k, which is 2 in that unit


def bessel1(x):
    """Returns the Bessel function J1. The trapezoidal rule is exact for a periodic integrand with few harmonics."""
    t = (np.arange(128) + 0.5) * np.pi / 128
    return np.cos(t[:, None, None] - x[None] * np.sin(t)[:, None, None]).mean(0)


def waves(s, largest):
    """Returns the wave vectors k of the cell with |k| up to `largest`, in the order of |k|, one of each pair k and
    -k, and |chi(k)|^2/V for each."""
    reciprocal = 2 * np.pi * np.linalg.inv(s.cell)
    most = [int(largest * np.linalg.norm(row) / (2 * np.pi)) + 1 for row in s.cell]
    n = np.array([n for n in itertools.product(*(range(-m, m + 1) for m in most)) if n > (0,) * s.dim])
    k = n @ reciprocal.T
    size = np.linalg.norm(k, axis=1)
    order = np.argsort(size)
    order = order[size[order] <= largest * (1 + 1e-9)]
    k, size = k[order], size[order]
    x = size[:, None] * s.radius[None]
    if s.dim == 2:
        transform = 2 * np.pi * s.radius**2 * bessel1(x) / x
    else:
        transform = 4 * np.pi * s.radius**3 * (np.sin(x) - x * np.cos(x)) / x**3
    chi = (transform * np.exp(-1j * (k @ s.x.T))).sum(1)
    return size, np.abs(chi)**2 / s.volume


def log_bias(n):
    """Returns the mean of ln X, where X is the average of n exponential variables of mean 1."""
    return -np.euler_gamma + sum(1 / m for m in range(1, int(n))) - math.log(n)


def fit(table):
    """Fits the law to ln I by least squares; returns None if there are too few bins."""
    used = [b for b, k in enumerate(table["k"]) if k <= RANGE * table["unit"]]
    if len(used) < 6:
        return None
    k, n = np.array(table["k"])[used], np.array(table["n_vectors"])[used]
    y = np.log(np.array(table["I"])[used]) - np.array([log_bias(m) for m in n])

    def model(theta):
        x = np.exp(theta[1]) * k / (2 * np.pi)
        return theta[0] - 0.5 * theta[2] * np.log1p(x**2), np.vstack(
            [np.ones_like(k), -theta[2] * x**2 / (1 + x**2), -0.5 * np.log1p(x**2)]).T

    best = None
    for start, slope in itertools.product(k[1::5], (1.0, 2.5)):
        theta, damping = np.array([y[0], np.log(2 * np.pi / start), slope]), 1e-3
        value, J = model(theta)
        cost = (n * (y - value)**2).sum()
        for _ in range(1000):
            A = J.T @ (n[:, None] * J)
            step = np.linalg.solve(A + damping * np.diag(np.diag(A)) + 1e-9 * A.max() * np.eye(3), J.T @ (n * (y - value)))
            if not np.abs(step).max() < 50:
                damping *= 10
                continue
            new_value, new_J = model(theta + step)
            new = (n * (y - new_value)**2).sum()
            if new <= cost:
                theta, value, J, damping = theta + step, new_value, new_J, damping / 10
                done = cost - new < 1e-13 * cost
                cost = new
                if done:
                    break
            else:
                damping *= 10
                if damping > 1e12:
                    break
        if best is None or cost < best[0]:
            best = cost, theta, J
    cost, theta, J = best
    dof = len(k) - 3
    covariance = np.linalg.inv(J.T @ (n[:, None] * J)) * max(1.0, cost / dof)
    with np.errstate(invalid="ignore"):  # of a minimum at infinity rounding leaves no variance
        error = np.sqrt(np.diag(covariance))
    return {"theta": theta, "error": error, "low": k[0], "high": k[-1], "n": len(k),
            "chi_square": cost / dof, "t": T95[dof] if dof < len(T95) else None}


# Quantiles of Student's t for 95 %, by degrees of freedom.
T95 = (None, 12.706, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, 2.2010, 2.1788, 2.1604,
       2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639, 2.0595, 2.0555, 2.0518,
       2.0484, 2.0452, 2.0423)


def in_range(check, part, dF):
    """Requires dF within its physical range. The slope of smooth surfaces, 4, is the steepest possible slope. The
    interval may end there and at 0. A value beyond this range may be missing; then only the ends of the range are
    known."""
    beyond = not 0 <= dF <= 4
    cut = {"_low95": 0.0, "_high95": 4.0}.get(part) if beyond else min(4.0, max(0.0, check.expected))
    return Holds(f"{check.expected}, or what of it is from 0 to 4", lambda v: check.fault(v) is None or (
        v == cut if part in ("_low95", "_high95") else v is None and beyond))


def fit_columns(found):
    names = [f"{name}{part}" for name in ("xi", "dF", "I0") for part in ("", "_stderr", "_low95", "_high95")]
    names += ["fit_low", "fit_high", "fit_points", "chi_square"]
    if found is None:
        return {name: Same(None) for name in names}
    (I0, xi, dF), (eI, ex, ed), t = found["theta"], found["error"], found["t"]
    known = {"I0": t * eI < math.log(10), "xi": t * ex < math.log(10)}
    known["dF"] = known["xi"]  # where it is not known the least square may lie at infinity
    values = {"I0": (math.exp(I0), math.exp(I0) * eI, math.exp(I0 - t * eI), math.exp(min(700, I0 + t * eI))),
              "xi": (math.exp(xi), math.exp(xi) * ex, math.exp(xi - t * ex), math.exp(min(700, xi + t * ex))),
              "dF": (dF, ed, dF - t * ed, dF + t * ed)}
    out = {}
    for name, numbers in values.items():
        for part, number in zip(("", "_stderr", "_low95", "_high95"), numbers):
            check = Close(number if known[name] else None, 0, 1e-4 if known["xi"] else 5e-3)
            out[name + part] = check if name != "dF" or not known[name] else in_range(check, part, dF)
    return out | {"fit_low": Close(found["low"]), "fit_high": Close(found["high"]), "fit_points": Same(found["n"]),
                  "chi_square": Close(found["chi_square"], 0, 1e-5 if known["xi"] else 5e-3)}


def smooth(n):
    while True:
        rest = n
        for factor in (2, 3, 5, 7):
            while rest % factor == 0:
                rest //= factor
        if rest == 1:
            return n
        n += 1


def intensity(s, table):
    """Returns the expected columns; the bins begin at the smallest wave vector and follow each other without gaps."""
    size, I = waves(s, max(table["k"]) * 1.3)
    ends = np.cumsum(table["n_vectors"])
    starts = ends - np.array(table["n_vectors"])
    k = np.array([size[a:b].mean() for a, b in zip(starts, ends)])
    mean = np.array([I[a:b].mean() for a, b in zip(starts, ends)])
    n = len(k)
    # On a mesh, shorter waves are aliased to longer ones, so the tolerance is larger.
    return {"file": Same([s.path] * n), "k": Close(k), "I": Close(mean, 0.05 * mean.max(), 1e-2 if s.dim == 2 else 1e-8),
            "n_vectors": Holds("all wave vectors up to the last", lambda v: sum(v) == (size <= max(
                size[:ends[-1]]) * (1 + 1e-9)).sum())}


def with_fit(row, table):
    law = None
    if all(row[name] is not None for name in ("I0", "xi", "dF")):
        def law(k):
            return row["I0"] / (1 + (k * row["xi"] / (2 * np.pi))**2)**(row["dF"] / 2)
    return [law(k) if law and row["fit_low"] <= k <= row["fit_high"] else None for k in table["k"]]


def columns(s, row, table):
    names = ("mesh_spacing", "mesh1", "mesh2", "n_pores", "pore_size", "pore_mean_area", "pore_unbounded", "n_voids",
             "local_phi_mean", "local_phi_stddev", "void_radius_mean", "void_radius_largest")
    out = {"file": Same(s.path), "dimension": Same(s.dim), "n_grains": Same(s.n),
           "P_star": Close(s.reduced(s.P), s.reduced(s.stress_scale)),
           "P_driven_star": s.driven_columns()["P_driven_star"], "phi": Close(s.phi), "seconds": Exempt("a time")}
    out |= {name: Same(None) for name in names}
    if s.walls:
        return out | fit_columns(None)
    out |= fit_columns(fit(table | {"unit": 2 * np.pi / s.a}))
    if s.dim == 2:
        spacing = s.a / 2 / CELLS
        out["mesh_spacing"] = Close(spacing)
        for a in (0, 1):
            out[f"mesh{a + 1}"] = Same(smooth(math.ceil(np.linalg.norm(s.cell[a]) / spacing)))
        found, unbounded = find_pores(s)
        areas = np.array([pore["area"] for pore in found])
        gyration = np.array([pore["gyration_radius"] for pore in found])
        out |= {"n_pores": Same(len(found)), "pore_mean_area": Close(areas.mean()), "pore_unbounded": Same(unbounded),
                "pore_size": Close(math.sqrt((areas * gyration**2).sum() / areas.sum()))}
    else:
        volume, balls = voids.voronoi(s)
        local = s.ball / volume
        radii = np.array([radius for _, radius in balls])
        out |= {"local_phi_mean": Close(local.mean(), 0, 1e-6), "local_phi_stddev": Close(local.std(), 0, 1e-6),
                "n_voids": Same(len(balls)), "void_radius_mean": Close(radii.mean(), 0, 1e-5),
                "void_radius_largest": Close(radii.max(), 0, 1e-5)}
    return out


def pair_correlation(s, table, first):
    n = len(table["r"])
    width = REACH * s.a / math.ceil(REACH * 50)
    i, _, r = s.neighbours(REACH * s.a)
    length = np.linalg.norm(r, axis=1)
    edges = width * np.arange(n + 1)
    ball = np.pi * edges**2 * (1 if s.dim == 2 else 4 / 3 * edges)
    shell = np.diff(ball)
    inner = np.ones(s.n, bool)
    volume = s.volume
    if s.walls:
        for axis, side, place in zip(s.walls["axis"], s.walls["side"], s.walls["position"]):
            inner &= side * (place - s.x[:, axis]) >= REACH * s.a
        for axis in s.walled_axes():
            volume *= max(0.0, s.cell[axis, axis] - 2 * REACH * s.a) / s.cell[axis, axis]
    counts = np.bincount(np.minimum(n - 1, (length[inner[i]] / width).astype(int)), minlength=n)
    pairs = counts if s.walls else counts // 2
    density = inner.sum() / volume if volume else 0.0
    # Without a grain that is further from all walls than the reach, g is not defined.
    g = Close(counts / (inner.sum() * density * shell)) if inner.any() else Same([None] * n)
    r = edges[:-1] + width / 2
    return {"file": Same([s.path] * n), "r": Close(r), "g": g, "n_pairs": Same(pairs.tolist()),
            "r_rescaled": Close(r * (s.phi / first.phi)**(1 / s.dim))}


def gaps(s, table, first):
    h = np.array(table["gap"])
    n = len(h)
    i, j, r = s.neighbours(2 * s.a * (1 + 1e-9))
    gap = np.linalg.norm(r, axis=1) - (s.radius[i] + s.radius[j])
    touch = 1e-12 * s.a
    z = np.array([(gap <= x + touch).sum() / s.n for x in h])
    rattler = s.rattlers(s.tolerances[0] * s.F1(s.target.mean()))
    steady = ~rattler[i] & ~rattler[j]
    held = np.array([(gap[steady] <= x + touch).sum() / s.n for x in h])
    # A rattler that is pushed against other grains touches as many grains as there are dimensions.
    least = held + 2 * s.dim * rattler.sum() / s.n if rattler.any() else held
    pushed = Close(z) if not rattler.any() else Holds("that of the others, and contacts of rattlers", lambda v: (
        (np.array(v) >= least - 1e-9).all() and (np.diff(v) >= -1e-9).all() and v[0] <= least[0] + 2 * rattler.sum() / s.n))
    scale = (s.phi / first.phi)**(1 / s.dim)
    return {"file": Same([s.path] * n), "gap": Close(np.array([0.0] + [s.a * 10**(m / 10) for m in range(-60, 1)])),
            "z": Close(z), "z_pushed": pushed, "gap_rescaled": Close(scale * (s.a + h) - s.a, s.a)}


def normal_force(s, h, Ri, Rj):
    """Returns the normal force of the law at gaps h."""
    law = s.law
    if law["normal"] == "hertz":
        E = law["normal_modulus"] / (2 * (1 - law["normal_poisson"]**2))
        R = Ri * Rj / (Ri + Rj)
        N = np.where(h < 0, 4 / 3 * E * np.sqrt(R) * np.maximum(-h, 0)**1.5, 0)
    else:
        N = np.where(h < 0, -law["normal_stiffness"] * h, 0)
    if law["adhesion"] == "none":
        return N
    F0, reach = law["adhesion_force"], law.get("adhesion_range", 0.0)
    fading = np.maximum(0, 1 - np.maximum(h, 0) / reach) if reach > 0 else 0.0
    return N - np.where(h < 0, F0, F0 * fading)


def prediction(s, table, first):
    scale = (first.phi / s.phi)**(1 / s.dim)
    i, j, r = first.neighbours((1 + 0.1) * first.a / scale)
    length = np.linalg.norm(r, axis=1) * scale
    h = length - first.radius[i] - first.radius[j]
    rattler = first.rattlers(first.tolerances[0] * first.F1(first.target.mean()))
    z = (h <= 1e-12 * s.a).sum() / s.n
    if s.law["adhesion"] == "capillary":
        P = Exempt("the bridges of the first state are shared out anew")
    elif s.rigid:  # no force follows from their gaps
        P = Close([0.0])
    else:
        force = normal_force(s, h, first.radius[i], first.radius[j])
        total = (force * length).sum() / 2 / s.dim / (first.volume * scale**s.dim)
        P = Close([total], np.abs(force * length).sum() / s.volume, 1e-7)
    steady = (~rattler[i] & ~rattler[j] & (h <= 1e-12 * s.a)).sum() / s.n
    pushed = Close([z]) if not rattler.any() else Holds("no less than that of the others", lambda v: (
        steady <= v[0] <= steady + 12 * rattler.sum() / s.n))
    return {"reference": Same([first.path]), "file": Same([s.path]), "phi": Close([s.phi]), "P": Close([s.P], s.stress_scale),
            "z": Close([2 * s.counted.sum() / s.n]), "P_predicted": P, "z_predicted": Close([z]),
            "z_pushed_predicted": pushed}


NODES = np.polynomial.legendre.leggauss(24)


def gauss(low, high):
    x, w = NODES
    return (high - low) / 2 * x + (high + low) / 2, (high - low) / 2 * w


def ball_in_box(centre, R, half):
    """Returns by quadrature the common volume (area) of a ball and a box with the half widths `half` about the
    origin."""
    low, high = np.maximum(-half, centre - R), np.minimum(half, centre + R)
    if (low >= high).any():
        return 0.0
    if (np.abs(centre) + R <= half).all():
        return np.pi * R**2 if len(centre) == 2 else 4 / 3 * np.pi * R**3
    if len(centre) == 2:
        # The integral is divided where the chord meets an edge, and uses an angle as variable, so that the integrand
        # is smooth at the ends.
        cuts = {low[0], high[0]}
        for edge in (-half[1], half[1]):
            rest = R**2 - (edge - centre[1])**2
            if rest > 0:
                cuts |= {centre[0] + sign * math.sqrt(rest) for sign in (-1, 1)}
        cuts = sorted(x for x in cuts if low[0] <= x <= high[0])
        total = 0.0
        for a, b in zip(cuts, cuts[1:]):
            t, w = gauss(math.asin(max(-1, min(1, (a - centre[0]) / R))), math.asin(max(-1, min(1, (b - centre[0]) / R))))
            chord = R * np.cos(t)
            top, bottom = np.minimum(half[1], centre[1] + chord), np.maximum(-half[1], centre[1] - chord)
            total += (w * R * np.cos(t) * np.maximum(0, top - bottom)).sum()
        return total
    t, w = gauss(math.asin(max(-1, (low[2] - centre[2]) / R)), math.asin(min(1, (high[2] - centre[2]) / R)))
    return sum(weight * R * math.cos(x) * ball_in_box(centre[:2], R * math.cos(x), half[:2]) for x, weight in zip(t, w))


def solid_fraction_in(s, centre, half):
    reach = np.linalg.norm(half) + s.radius.max()
    total = 0.0
    for image in s.images(reach + np.linalg.norm(s.cell, axis=1).sum() / 2):
        for x, R in zip(s.x + image @ s.cell - centre, s.radius):
            if (np.abs(x) - R < half).all():
                total += ball_in_box(x, R, half)
    return total / np.prod(2 * half)


def porosity(s, table, first):
    heights = 1 / np.linalg.norm(np.linalg.inv(s.cell), axis=0)
    centre = s.cell.sum(0) / 2
    for axis in s.walled_axes():
        centre[axis] = s.walls["position"][s.walls["axis"] == axis].mean()
    right = np.count_nonzero(s.cell - np.diag(np.diag(s.cell))) == 0
    half = np.array([0.5 * k / PROBES for k in range(1, PROBES + 1)])
    cube = [solid_fraction_in(s, centre, np.full(s.dim, h * heights.min())) for h in half]
    cell = [solid_fraction_in(s, centre, h * np.diag(s.cell)) if right else None for h in half]
    empty = [None] * PROBES
    out = {"file": Same([s.path] * PROBES), "half_side": Close(half),
           "porosity": Close([1 - phi for phi in cube], 1.0, 1e-4), "void_ratio": Close([1 / phi - 1 for phi in cube], 1.0, 1e-3)}
    out["porosity_cell"] = Close([1 - phi for phi in cell], 1.0, 1e-4) if right else Same(empty)
    out["void_ratio_cell"] = Close([1 / phi - 1 for phi in cell], 1.0, 1e-3) if right else Same(empty)
    return out


def below(x, R, dim):
    """Returns the volume of the part of a ball about 0 that lies below a plane at x."""
    x = np.clip(x, -R, R)
    if dim == 3:
        return np.pi * (R**2 * x - x**3 / 3 + 2 / 3 * R**3)
    return R**2 * np.arcsin(x / R) + x * np.sqrt(np.maximum(R**2 - x**2, 0)) + np.pi / 2 * R**2


def profile(s, table, first):
    axis = s.dim - 1
    inverse = np.linalg.inv(s.cell)[:, axis]
    height = 1 / np.linalg.norm(inverse)
    place = s.x @ inverse * height
    walled = axis in s.walled_axes()
    if walled:
        place -= min(s.walls["position"][s.walls["axis"] == axis])
    else:
        place %= height
    edges = height * np.arange(SLICES + 1) / SLICES
    phi = np.zeros(SLICES)
    for shift in [0] if walled else [-height, 0, height]:
        volume = below(edges[:, None] - place - shift, s.radius, s.dim).sum(1)
        phi += np.diff(volume) / (s.volume / SLICES)
    own = np.clip((place / height * SLICES).astype(int), 0, SLICES - 1)
    count = np.bincount(own, minlength=SLICES)
    contacts = np.bincount(s.i[s.touching], minlength=s.n) + np.bincount(s.j[s.counted], minlength=s.n)
    z = [contacts[own == k].mean() if count[k] else None for k in range(SLICES)]
    p = pressures(s)
    pressure = Close(np.array([p[own == k].mean() if count[k] else None for k in range(SLICES)], object), np.abs(p).max())
    # The stress of a slice is the mean stress across its planes; each contact crosses the planes between its ends.
    begin = (s.x[s.i] @ inverse - (min(s.walls["position"][s.walls["axis"] == axis]) / height if walled else 0)) * SLICES
    step = s.branch @ inverse * SLICES
    on_j = s.N[:, None] * s.normal - s.shear
    stress = np.zeros((SLICES, s.dim))
    for first, length, along in zip(begin, step, on_j * s.branch / (s.volume / SLICES)):
        cuts = sorted({0.0, 1.0, *((k - first) / length for k in range(-3 * SLICES, 4 * SLICES) if length and
                                   0 < (k - first) / length < 1)})
        for a, b in zip(cuts, cuts[1:]):
            k = int(np.floor(first + 0.5 * (a + b) * length))
            stress[min(max(k, 0), SLICES - 1) if walled else k % SLICES] += (b - a) * along
    sigma = {f"sigma_{a + 1}": Close(stress[:, a], np.abs(stress).max()) if a < s.dim else Same([None] * SLICES) for a in range(3)}
    return sigma | {"file": Same([s.path] * SLICES), "low": Close(edges[:-1]), "high": Close(edges[1:]), "phi": Close(phi),
            "void_ratio": Close([1 / x - 1 for x in phi], 1.0), "n_grains": Same(count.tolist()),
            "z": Close(np.array(z, object)), "pressure": pressure}


def wrapped(s, x):
    reduced = np.linalg.solve(s.cell.T, np.atleast_2d(x).T).T
    return (reduced - np.floor(reduced)) @ s.cell


def same_places(s, places, others, slack):
    """Matches two lists of positions in the cell in any order; returns the matches, or None if the positions
    differ."""
    taken = []
    for x in places:
        reduced = np.linalg.solve(s.cell.T, (np.asarray(others) - x).T).T
        distance = np.linalg.norm((reduced - np.round(reduced)) @ s.cell, axis=1)
        taken.append(int(np.argmin(distance)))
        if distance[taken[-1]] > slack:
            return None
    return taken


def pores_table(s, table, first):
    n = len(table["file"])
    places = np.array([table[f"x{a + 1}"] for a in range(s.dim)]).T
    out = {"file": Same([s.path] * n)}
    if s.dim == 2:
        found, _ = find_pores(s)
        found = [pore for pore in found]
        order = same_places(s, places, [pore["centre"] for pore in found], 1e-6 * s.a)
        out |= {f"x{a + 1}": Holds("centres of the pores", lambda _: order is not None and len(found) == n) for a in (0, 1)}
        pick = [found[k] for k in order] if order is not None else found
        out |= {name: Close([pore[name] for pore in pick], 0, 1e-6) for name in ("area", "gyration_radius")}
        out["n_grains"] = Same([pore["n_grains"] for pore in pick])
        return out
    _, balls = voids.voronoi(s)
    order = same_places(s, places, [x for x, _ in balls], 1e-5 * s.a)
    out |= {f"x{a + 1}": Holds("centres of the balls", lambda _: order is not None and len(set(order)) == len(balls) == n)
            for a in range(3)}
    out["radius"] = Close([balls[k][1] for k in order] if order is not None else [], s.a, 1e-6)
    return out


def local_map(s, table, first):
    n = len(table["file"])
    out = {"file": Same([s.path] * n)}
    if s.dim == 3:
        volume, _ = voids.voronoi(s)
        out |= {f"x{a + 1}": Same(s.x[:, a].tolist()) for a in range(3)}
        return out | {"grain": Same(list(range(s.n))), "voronoi_volume": Close(volume, 0, 1e-6),
                      "solid_fraction": Close(s.ball / volume, 0, 1e-6)}
    fine = 60
    step = (np.arange(SIDE * fine) + 0.5) / (SIDE * fine)
    points = np.stack(np.meshgrid(step, step, indexing="ij"), -1) @ s.cell
    inside = np.zeros(points.shape[:2])
    middle, reach = s.cell.sum(0) / 2, np.linalg.norm(s.cell, axis=1).sum() / 2
    for image in s.images(s.a):
        for x, R in zip(s.x + image @ s.cell, s.radius):
            if np.linalg.norm(x - middle) < reach + R:
                inside += (points[..., 0] - x[0])**2 + (points[..., 1] - x[1])**2 < R**2
    share = inside.reshape(SIDE, fine, SIDE, fine).mean((1, 3)).ravel()
    k = list(itertools.product(range(SIDE), range(SIDE)))
    centre = (np.array(k) + 0.5) / SIDE @ s.cell
    return out | {"k1": Same([a for a, _ in k]), "k2": Same([b for _, b in k]), "x1": Close(centre[:, 0]),
                  "x2": Close(centre[:, 1], s.a), "solid_fraction": Close(share, 1.0, 5e-3)}


FILES = {"--pair-correlation": pair_correlation, "--porosity": porosity, "--profile": profile, "--gaps": gaps,
         "--prediction": prediction, "--pores": pores_table, "--map": local_map}
IN_BOXES = ("--pair-correlation", "--porosity", "--profile")
TABLES = {"structure": "floc structure", "structure --intensity": "--intensity",
          **{f"structure {option}": option for option in FILES}}


def check(program, states, tally):
    for samples in states.values():
        first = samples[0]
        if first.shapes:
            continue  # floc describes the structure of disks and spheres alone
        for s in samples:
            files = [option for option in FILES if option in IN_BOXES or not s.walls]
            arguments = [word for option in files for word in (option, option[2:] + ".csv")]
            if not s.walls:
                arguments += ["--intensity", "intensity.csv"]
            rows = program.rows("structure", *dict.fromkeys((first.path, s.path)), *arguments, "--reach", REACH,
                                "--map-size", f"{SIDE},{SIDE}", "--probes", PROBES, "--slices", SLICES, "--fit-range",
                                f"0,{RANGE}", "--cells-per-wave", CELLS)
            tables = {option: of(program.table(option[2:] + ".csv"), s.path) for option in files + ["--intensity"] * (not s.walls)}
            spectrum = tables.get("--intensity")
            tally.row("structure", s.path, rows[-1], columns(s, rows[-1], spectrum))
            if spectrum:
                tally.row("structure --intensity", s.path, spectrum, intensity(s, spectrum) | {
                    "I_fit": Close(with_fit(rows[-1], spectrum))})
            for option in files:
                tally.row(f"structure {option}", s.path, tables[option], FILES[option](s, tables[option], first))


def of(table, file):
    keep = [k for k, name in enumerate(table["file"]) if name == file]
    return {name: [values[k] for k in keep] for name, values in table.items()}
