"""The stiffness matrix of the contacts of a state as a dense array, and results of plain linear algebra with it."""
import functools

import numpy as np

ZERO = 1e-11  # an eigenvalue below it, over the largest, is what rounding leaves of none


def unit_strains(dim, full):
    """Returns symmetric strains: extensions along the axes, then gamma = 1 for each pair of axes: 23, 13, 12 in
    3D."""
    strains = [np.diag(row) for row in np.eye(dim)]
    pairs = [(1, 2), (0, 2), (0, 1)] if dim == 3 else [(0, 1)]
    for p, q in pairs if full else []:
        strain = np.zeros((dim, dim))
        strain[p, q] = strain[q, p] = 0.5
        strains.append(strain)
    return strains


class Network:
    """Contacts of all grains except rattlers, as springs.

    The unknowns are displacement and rotation times the radius of each grain, then strains of the cell and, between
    walls, the common displacement of both walls of an axis. Strains are positive in compression.
    """

    def __init__(self, state, force_tolerance=1e-5, rolling_stiffness=None, members=None):
        s = self.state = state
        self.smallest = force_tolerance * s.F1(np.trace(s.load_stress) / s.dim)
        if members is None:
            out = s.rattlers(self.smallest)
            members = ~out[s.i] & (s.on_wall | ~out[np.where(s.on_wall, 0, s.j)])
        self.k = np.flatnonzero(members)  # numbers of its contacts in the state
        self.kr = s.kr[self.k] if rolling_stiffness is None else np.where(s.distant[self.k], 0.0, rolling_stiffness)
        self.turns = 1 if s.dim == 2 else 3
        self.dofs = s.dim + self.turns
        self.axes = s.walled_axes()
        held = np.zeros(s.n, int)
        np.add.at(held, s.i[self.k], 1)
        inner = self.k[~s.on_wall[self.k]]
        np.add.at(held, s.j[inner], 1)
        self.degree = held
        self.connected = held > 0
        self.n_rattlers = int((~self.connected).sum())

    def rows(self, k, position, full):
        """Returns the change of a contact per unit of each unknown: translations along (-n, tangents...) and relative
        rotations. Returns the stiffnesses as well."""
        s, dim = self.state, self.state.dim
        n = s.normal[k]
        tangents = np.linalg.svd(n[None])[2][1:]
        frame = np.vstack([-n, tangents])
        strains = unit_strains(dim, full)
        size = s.n * self.dofs + len(strains) + len(self.axes)
        slide = np.zeros((dim, size))  # relative displacement of the two surfaces, by component
        turn = np.zeros((self.turns, size))
        move = np.zeros((dim, size))  # of the two centres
        first = self.dofs * np.array([s.i[k], s.j[k]])
        wall = s.on_wall[k]
        r = s.branch[k].copy()
        arms = (s.share_i[k] * s.length[k] * n, (s.share_i[k] - 1) * s.length[k] * n)
        for side, sign in ((0, -1.0), (1, 1.0)):
            if side == 1 and wall:
                continue
            grain, at = (s.i[k], s.j[k])[side], first[side]
            for a in range(dim):
                slide[a, at + a] += sign
                move[a, at + a] += sign
            for b in range(self.turns):
                # The displacement is w x arm, where w is a unit rotation about axis b divided by the radius.
                if dim == 2:
                    spun = np.array([-arms[side][1], arms[side][0]])
                else:
                    spun = np.cross(np.eye(3)[b], arms[side])
                slide[:, at + dim + b] += sign * spun / s.radius[grain]
                turn[b, at + dim + b] += sign / s.radius[grain]
        if wall:
            axis = s.walls["axis"][s.j[k] - s.n]
            for b in self.axes:
                if b != axis:
                    middle = s.walls["position"][s.walls["axis"] == b].mean()
                    r[b] = middle - s.x[s.i[k], b]
            shift = s.n * self.dofs + len(strains) + self.axes.index(axis)
            slide[:, shift] += n * n[axis]
        for e, strain in enumerate(strains):
            slide[:, s.n * self.dofs + e] -= strain @ r
            move[:, s.n * self.dofs + e] -= strain @ r
        G = [frame @ slide]
        stiffness = [s.kn[k]] + [s.kt[k]] * (dim - 1)
        if dim == 2:
            G.append(turn)
            stiffness.append(self.kr[position])
        else:
            G.append(np.vstack([n, tangents]) @ turn)
            stiffness += [s.ktw[k]] + [self.kr[position]] * 2
        return np.vstack(G), np.array(stiffness), tangents, tangents @ move

    @functools.lru_cache(maxsize=None)
    def assembled(self, full=False):
        """Returns for each contact the matrix G, the stiffnesses k, and their geometric parts."""
        parts = [self.rows(k, p, full) for p, k in enumerate(self.k)]
        return parts

    @functools.lru_cache(maxsize=None)
    def K(self, full=False, prestress=False):
        s = self.state
        n_boundary = (len(unit_strains(s.dim, full)) + len(self.axes))
        size = s.n * self.dofs + n_boundary
        K = np.zeros((size, size))
        for k, (G, stiffness, _, across) in zip(self.k, self.assembled(full)):
            K += G.T @ (stiffness[:, None] * G)
            if prestress and not s.on_wall[k]:
                K -= s.N[k] / s.length[k] * across.T @ across
        return K

    def n_strains(self, full=False):
        return len(unit_strains(self.state.dim, full))

    def n_grain_unknowns(self):
        return self.state.n * self.dofs

    @functools.lru_cache(maxsize=None)
    def relaxed(self, full=False, prestress=False):
        """Returns C and the motion of grains and walls for unit strains, after elimination of walls and grains."""
        K = self.K(full, prestress)
        m, n = self.n_grain_unknowns(), self.n_strains(full)
        strains = np.arange(m, m + n)
        free = np.setdiff1d(np.arange(len(K)), strains)
        A, b = K[np.ix_(free, free)], K[np.ix_(free, strains)]
        values, vectors = np.linalg.eigh(A)
        kept = np.abs(values) > ZERO * np.abs(values).max()
        motion = -vectors[:, kept] @ ((vectors[:, kept].T @ b) / values[kept, None])
        # One step of iterative refinement removes the error of the inverse.
        motion -= vectors[:, kept] @ ((vectors[:, kept].T @ (A @ motion + b)) / values[kept, None])
        C = (K[np.ix_(strains, strains)] + b.T @ motion) / self.state.volume
        if prestress:
            C = C + self.convected(full)
        whole = np.zeros((len(K), n))
        whole[free] = motion
        whole[strains, np.arange(n)] = 1.0
        return (C + C.T) / 2, whole

    def convected(self, full):
        """Returns the term -sym(sigma E) + sigma tr E, symmetrised (docs/physics.md, "Prestress")."""
        sigma = self.state.load_stress
        strains = unit_strains(self.state.dim, full)
        added = np.zeros((len(strains),) * 2)
        for b, E in enumerate(strains):
            change = sigma * np.trace(E) - (sigma @ E + (sigma @ E).T) / 2
            for a, unit in enumerate(strains):
                added[a, b] = np.trace(change.T @ unit)
        return (added + added.T) / 2

    def spectrum(self, full=False):
        """Returns the eigenvalues of K, for grains and strains in comparable units of length, divided by the largest
        eigenvalue."""
        K = self.K(full).copy()
        m = self.n_grain_unknowns()
        scale = np.ones(len(K))
        scale[m:m + self.n_strains(full)] = 1 / self.state.volume ** (1 / self.state.dim)
        K = scale[:, None] * K * scale
        values = np.linalg.eigvalsh(K)
        return values / np.abs(values).max()

    def modes(self):
        """Returns eigenvalues and eigenvectors of K for the connected grains at fixed strains."""
        m = self.n_grain_unknowns()
        rows = np.flatnonzero(np.repeat(self.connected, self.dofs))
        values, vectors = np.linalg.eigh(self.K()[:m, :m][np.ix_(rows, rows)])
        whole = np.zeros((m, len(rows)))
        whole[rows] = vectors
        return values, whole

    def dead_ends(self):
        """Returns the grains that are attached by a single contact, or by a chain of such grains."""
        s = self.state
        out, active = np.zeros(s.n, bool), np.ones(len(self.k), bool)
        while True:
            i, j, wall = s.i[self.k][active], s.j[self.k][active], s.on_wall[self.k][active]
            count = np.bincount(i, minlength=s.n) + np.bincount(j[~wall], minlength=s.n)
            more = ~out & (count == 1)
            if not more.any():
                return out
            # If two grains have only their common contact, the grain that holds the other is kept.
            for grain in np.flatnonzero(more):
                mine = active & ((s.i[self.k] == grain) | (s.j[self.k] == grain))
                if mine.any():
                    out[grain] = True
                    active &= ~mine

    def edges(self, keep=None):
        """Returns (i, j, image) of the contacts between grains."""
        s = self.state
        return [(s.i[k], s.j[k], s.image[k]) for p, k in enumerate(self.k)
                if not s.on_wall[k] and (keep is None or keep[p])]
