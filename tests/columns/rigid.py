"""Forces of rigid grains at rest: the forces of least elastic energy, and the number of force components that the
geometry does not determine."""
import numpy as np

from state import cross

SOLVED = 1e-11  # error of the balance, over the mean normal force


def balance(s):
    """Returns the matrix that maps the forces on the second grain of each contact (all components of one contact
    after the other) to the net force and the net moment divided by the radius of each grain, followed by the normal
    stress on each axis times the area of the cell across it."""
    turns = 1 if s.dim == 2 else 3
    dofs = s.dim + turns
    out = np.zeros((dofs * s.n + s.dim, s.dim * len(s.i)))
    for k in range(len(s.i)):
        for a, force in enumerate(np.eye(s.dim)):
            column = s.dim * k + a
            for grain, sign, arm in ((s.j[k], 1, s.arm_j[k]), (s.i[k], -1, s.arm_i[k])):
                first = dofs * grain
                out[first:first + s.dim, column] += sign * force
                out[first + s.dim:first + dofs, column] += sign * cross(arm, force) / s.radius[grain]
            out[dofs * s.n + a, column] = s.branch[k, a] / s.cell[a, a]
    return out


def frames(s):
    """Returns the normal and the tangents of each contact as rows."""
    return np.array([np.vstack([n, np.linalg.svd(n[None])[2][1:]]) for n in s.normal])


def nearest_in_cone(v, mu):
    """Returns the forces (P, T) in Coulomb's cones that are nearest to v, and their derivatives with respect to v."""
    m, dim = v.shape
    size = np.linalg.norm(v[:, 1:], axis=1)
    x, change = np.zeros_like(v), np.zeros((m, dim, dim))
    sticks = size <= mu * v[:, 0]
    x[sticks], change[sticks] = v[sticks], np.eye(dim)
    for k in np.flatnonzero(~sticks & (v[:, 0] + mu * size > 0)):
        P = (v[k, 0] + mu * size[k]) / (1 + mu**2)
        along = v[k, 1:] / size[k] if size[k] > 0 else 0 * v[k, 1:]
        edge = np.concatenate([[1.0], mu * along])
        x[k] = P * edge
        change[k] = np.outer(edge, edge) / (1 + mu**2)
        if size[k] > 0:
            change[k, 1:, 1:] += mu * P / size[k] * (np.eye(dim - 1) - np.outer(along, along))
    return x, change


def least_energy(s):
    """Returns the forces (P, T) of the contacts with the least sum of squares that lie in Coulomb's cones and balance
    all grains and the normal stresses. These are the points of the cones nearest to B^T y, for the y at which they
    are balanced. Newton's method on the dual energy finds this y."""
    mu = float(s.law.get("friction_coefficient", 0.0))
    m = len(s.i)
    frame = frames(s)
    whole = balance(s)
    B = np.einsum("rka,kca->rkc", whole.reshape(-1, m, s.dim), frame)
    unit = np.abs(s.elastic).mean()
    # The repulsive parts of the forces balance the load and the adhesion.
    load = np.zeros(len(B))
    load[-s.dim:] = (whole @ s.force_on_j.ravel())[-s.dim:]
    load = (load + B[:, :, 0] @ (s.elastic - s.N)) / unit
    # The stress on an axis with imposed length may have any value.
    kept = np.concatenate([np.ones(len(B) - s.dim, bool), s.target_side == 0])
    B, load = B[kept], load[kept]
    y, damping = np.zeros(len(B)), 1e-6

    def at(y):
        x, change = nearest_in_cone(np.einsum("r,rkc->kc", y, B), mu)
        return x, change, np.einsum("rkc,kc->r", B, x) - load, 0.5 * (x**2).sum() - load @ y

    x, change, error, energy = at(y)
    for _ in range(400):
        if np.abs(error).max() < SOLVED:
            return unit * x, frame
        tangent = np.einsum("rkc,kcd,qkd->rq", B, change, B)
        step = -np.linalg.solve(tangent + damping * np.eye(len(y)), error)
        length = 1.0
        while length > 1e-10:
            new = at(y + length * step)
            if new[3] <= energy + 1e-4 * length * (error @ step) or np.abs(new[2]).max() < 0.9 * np.abs(error).max():
                break
            length /= 2
        y = y + length * step
        x, change, error, energy = new
        damping = max(min(1e-6, 1e-3 * np.abs(error).max()), 1e-13)
    raise AssertionError(f"{s.path}: forces of least energy balance to {np.abs(error).max():.1e} only")


def force_freedom(s):
    x, frame = least_energy(s)
    tangential = np.einsum("kc,kca->ka", x[:, 1:], frame[:, 1:])
    difference = (x[:, 0] - s.elastic)**2 + ((tangential + s.shear)**2).sum(1)  # s.shear acts on the first grain
    return np.sqrt(difference.sum() / (s.N**2 + (s.shear**2).sum(1)).sum())


def indeterminacy(s, smallest):
    """Returns the number of force components of the contacts that carry a force, minus the number of independent
    balance equations. A contact at its friction limit has one component."""
    carries = s.elastic > smallest
    slides = s.c["sliding"].astype(bool) | (s.law["friction"] == "none")
    kept = np.zeros((len(s.i), s.dim), bool)
    kept[carries] = True
    kept[slides, 1:] = False
    whole = balance(s).reshape(-1, len(s.i), s.dim)
    B = np.einsum("rka,kca->rkc", whole, frames(s))[:, kept]
    return int(kept.sum() - np.linalg.matrix_rank(B, 1e-8))
