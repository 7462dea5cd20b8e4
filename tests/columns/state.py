"""The arrays of a state file, read with h5py and numpy alone, and quantities that follow from them directly."""
import collections
import itertools

import h5py
import numpy as np

from checks import Close


def cross(a, b):
    """Returns the cross product a x b; in 2D its component normal to the plane."""
    return np.cross(a, b)


class State:
    """Arrays of a state with the names in docs/states.md; `distant` and others are flags."""

    def __init__(self, path):
        self.path = str(path)
        with h5py.File(path) as f:
            self.cell = f["cell/matrix"][:]
            self.x, self.radius = f["grains/position"][:], f["grains/radius"][:]
            self.x_low = f["grains/position_low"][:] if "position_low" in f["grains"] else None
            self.mass, self.v, self.w = (f["grains/" + name][:] for name in ("mass", "velocity", "angular_velocity"))
            self.c = {name: data[:] for name, data in f["contacts"].items() if name != "memory"}
            self.law = dict(f["law"].attrs)
            self.target = f["equilibrium/target"][:]
            self.saved_stress = f["equilibrium/stress"][:]
            self.residuals = f["equilibrium/residuals"][:]
            self.tolerances = f["equilibrium/tolerances"][:]
            self.n_negative = int(f["equilibrium/n_negative"][()])
            self.target_side = f["equilibrium/target_side"][:] if "target_side" in f["equilibrium"] else np.zeros(len(self.cell))
            self.path_attributes = dict(f["path"].attrs)
            self.motion = dict(f["motion"].attrs) if "motion" in f else None
            self.provenance = dict(f["provenance"].attrs)
            self.units = f.attrs["units"]
            scene = f["scene"][()]
            self.scene = scene.decode() if isinstance(scene, bytes) else str(scene)
            self.walls = {name: data[:] for name, data in f["walls"].items()} if "walls" in f else None
            self.shapes = {name: data[:] for name, data in f["shapes"].items()} if "shapes" in f else None
            if self.shapes:
                self.shape, self.scale = f["grains/shape"][:].astype(int), f["grains/scale"][:]
                self.orientation = f["grains/" + ("angle" if "angle" in f["grains"] else "orientation")][:]
        self.dim = len(self.cell)
        self.n = len(self.radius)
        self.volume = abs(np.linalg.det(self.cell))
        self.ball = np.pi * self.radius**2 * (1 if self.dim == 2 else 4 / 3 * self.radius)
        if self.shapes:
            self.ball = self.shapes["volume"][self.shape] * self.scale**self.dim
        self.rigid = self.law["normal"] == "rigid"
        self.mu = float(self.law.get("friction_coefficient", 0.0))
        self.phi = self.ball.sum() / self.volume
        self.a = 2 * self.radius.max()
        self._contacts()

    def turn(self, i):
        """Returns the matrix that rotates vectors from the axes of grain i to the axes of space."""
        if self.dim == 2:
            c, s = np.cos(self.orientation[i]), np.sin(self.orientation[i])
            return np.array([[c, -s], [s, c]])
        w, v = self.orientation[i][0], self.orientation[i][1:]
        skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        return np.eye(3) + 2 * w * skew + 2 * skew @ skew

    def _contacts(self):
        c, dim = self.c, self.dim
        self.i, self.j = c["id1"].astype(int), c["id2"].astype(int)
        self.on_wall = self.j >= self.n
        self.distant = c["distant"].astype(bool)
        self.N, self.normal = c["normal_force"], c["normal"]
        self.elastic, self.shear = c["elastic_force"], c["shear_force"]
        m = len(self.i)
        self.rolling = c["rolling_moment"].reshape(m, -1)
        self.twisting = c.get("twisting_moment", np.zeros(m))
        self.kn, self.kt, self.kr = c["kn"], c["kt"], c["kr"]
        self.ktw = c.get("ktw", np.zeros(m))
        inner = np.where(self.on_wall, 0, self.j)
        self.branch = self.x[inner] + c["image"] @ self.cell - self.x[self.i]
        self.radius_j = np.where(self.on_wall, 0.0, self.radius[inner])
        for k in np.flatnonzero(self.on_wall):
            axis, place = self.walls["axis"][self.j[k] - self.n], self.walls["position"][self.j[k] - self.n]
            self.branch[k] = 0
            self.branch[k, axis] = place - self.x[self.i[k], axis]
        self.length = np.linalg.norm(self.branch, axis=1)
        self.share_i = self.radius[self.i] / (self.radius[self.i] + self.radius_j)
        # Vectors from the centres of both grains to the contact point.
        self.arm_i = c["point"] if "point" in c else (self.share_i * self.length)[:, None] * self.normal
        self.arm_j = self.arm_i - self.branch if "point" in c else (
            ((self.share_i - 1) * self.length)[:, None] * self.normal)
        self.force_on_j = self.N[:, None] * self.normal - self.shear
        self.touching = ~self.distant
        self.counted = self.touching & ~self.on_wall  # what n_contacts counts
        self.image = c["image"].astype(int).reshape(m, dim)
        yields = [c[name].astype(bool) for name in ("sliding", "rolling_yield", "twisting_yield") if name in c]
        self.n_yielding = int(np.logical_or.reduce(yields).sum())

    # Stress and pressures.
    @property
    def stress(self):
        return self.force_on_j.T @ self.branch / self.volume

    @property
    def P(self):
        return np.trace(self.stress) / self.dim

    def on_driven_axis(self, stress):
        """Returns the stress on the driven axis, or the mean over the axes if no axis is driven."""
        axis = self.path_attributes.get("axis")
        return stress[axis - 1] if axis else stress.mean()

    def driven_columns(self):
        driven = self.on_driven_axis(np.diag(self.stress))
        return {"P_driven": Close(driven, self.stress_scale),
                "P_driven_star": Close(self.reduced(driven), self.reduced(self.stress_scale))}

    @property
    def stress_scale(self):
        """Returns the size of the terms whose sum is the stress."""
        return (np.linalg.norm(self.force_on_j, axis=1) * self.length).sum() / self.volume

    def walled_axes(self):
        return sorted(set(self.walls["axis"].tolist())) if self.walls else []

    def wall_pressure(self):
        """Returns the mean pressure on the two walls of each axis with walls."""
        out = {}
        for axis in self.walled_axes():
            area = self.volume / self.cell[axis, axis]
            on_axis = np.isin(self.j - self.n, np.flatnonzero(self.walls["axis"] == axis)) & self.on_wall
            out[axis] = self.N[on_axis].sum() / 2 / area
        return out

    @property
    def p_wall(self):
        pressures = list(self.wall_pressure().values())
        return float(np.mean(pressures)) if pressures else None

    @property
    def load_stress(self):
        """Returns the stress of the contacts, but the pressure of the walls on axes with walls."""
        stress = self.stress.copy()
        for axis, pressure in self.wall_pressure().items():
            stress[axis, axis] = pressure
        return stress

    # Scales.
    @property
    def F0(self):
        adhesion = self.law["adhesion"]
        if adhesion == "none":
            return 0.0
        if adhesion == "capillary":
            gamma = 2 * np.pi * self.law["adhesion_surface_tension"] * np.cos(np.radians(self.law["adhesion_contact_angle"]))
            return gamma * self.radius.max()
        return self.law["adhesion_force"]

    def F1(self, P):
        return max(self.F0, P * self.a ** (self.dim - 1))

    def reduced(self, P):
        """Returns the reduced pressure P*."""
        if self.F0 > 0:
            return self.a ** (self.dim - 1) * P / self.F0
        if self.law["normal"] == "hertz":
            return P / (self.law["normal_modulus"] / (1 - self.law["normal_poisson"] ** 2))
        if self.rigid:  # of contacts without end stiff
            return 0.0
        return self.a ** (self.dim - 2) * P / self.law["normal_stiffness"]

    # Balance.
    def net(self):
        """Returns the net force and the net moment of each grain."""
        force, moment = np.zeros((self.n, self.dim)), np.zeros((self.n, 1 if self.dim == 2 else 3))
        on_i = -self.force_on_j
        springs = self.rolling + (self.twisting[:, None] * self.normal if self.dim == 3 else 0)
        inner = ~self.on_wall
        np.add.at(force, self.i, on_i)
        np.add.at(force, self.j[inner], -on_i[inner])
        m = len(self.i)
        np.add.at(moment, self.i, cross(self.arm_i, on_i).reshape(m, -1) + springs)
        np.add.at(moment, self.j[inner], (cross(self.arm_j, -on_i).reshape(m, -1) - springs)[inner])
        return force, moment

    def kinetic(self):
        inertia = self.mass * (2 * self.radius) ** 2 / (8 if self.dim == 2 else 10)
        if self.shapes and self.dim == 2:
            inertia = self.mass * (self.shapes["inertia"].ravel() / self.shapes["volume"])[self.shape] * self.scale**2
        elif self.shapes:  # whose moments of inertia hang on the axis
            assert not self.w.any(), self.path
        return 0.5 * (self.mass * (self.v**2).sum(1) + inertia * (self.w.reshape(self.n, -1) ** 2).sum(1))

    def own_scales(self, P):
        """Returns F1 and a for each grain. If sizes differ more than fourfold, each grain has its own values."""
        if self.radius.max() <= 4 * self.radius.min():
            return np.full(self.n, self.F1(P)), np.full(self.n, self.a)
        d = 2 * self.radius
        F0 = self.F0 * (self.radius / self.radius.max() if self.law["adhesion"] == "capillary" else 1)
        return np.maximum(F0, P * d ** (self.dim - 1)), d

    # Rattlers and carrying structures.
    def rattlers(self, smallest):
        """Returns the rattlers (docs/physics.md, "Coordination and rattlers")."""
        ends = [(i, None if w else j) for i, j, w in zip(self.i, self.j, self.on_wall)]
        loaded = self.N > smallest
        if self.F0 > 0 or not loaded.any():
            out = np.ones(self.n, bool)
            for pair in ends:
                out[[b for b in pair if b is not None]] = False
            return out
        out = np.zeros(self.n, bool)
        while True:
            count, carries = np.zeros(self.n, int), np.zeros(self.n, bool)
            for (i, j), heavy in zip(ends, loaded):
                if out[i] or (j is not None and out[j]):
                    continue
                for b in (i, j):
                    if b is not None:
                        count[b] += 1
                        carries[b] |= heavy
            more = ~out & ((count < 2) | ~carries)
            if not more.any():
                return out
            out |= more

    def carrying(self, smallest, least):
        """Returns the contacts of the force-carrying structure, including contacts with walls, and the grains outside
        it."""
        kept, out = np.abs(self.N) > smallest, np.zeros(self.n, bool)
        while True:
            count = np.bincount(self.i[kept], minlength=self.n)
            count = count + np.bincount(self.j[kept & ~self.on_wall], minlength=self.n)
            more = ~out & (count < least)
            if not more.any():
                return kept, out
            out |= more
            kept &= ~out[self.i] & (self.on_wall | ~out[np.where(self.on_wall, 0, self.j)])

    def particle_stress(self):
        sums = np.zeros((self.n, self.dim, self.dim))
        np.add.at(sums, self.i, self.force_on_j[:, :, None] * self.arm_i[:, None, :])
        inner = ~self.on_wall
        np.add.at(sums, self.j[inner], -(self.force_on_j[:, :, None] * self.arm_j[:, None, :])[inner])
        return sums / (self.ball / self.phi)[:, None, None]

    def energy(self):
        """Returns the elastic energy of each contact."""
        if self.rigid:
            return np.zeros(len(self.N))
        h = np.maximum(-self.c["gap"], 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            normal = np.where((self.elastic > 0) & (h > 0), self.elastic**2 * h / (self.elastic + self.kn * h), 0)
        total = np.where(self.touching, normal, 0)
        for square, k in ((self.shear**2, self.kt), (self.rolling**2, self.kr), (self.twisting[:, None] ** 2, self.ktw)):
            total = total + np.where(self.touching & (k > 0), square.sum(1) / (2 * np.where(k > 0, k, 1)), 0)
        return total

    def images(self, reach):
        """Returns all lattice vectors (in cells) that pairs at distances up to `reach` may need."""
        heights = 1 / np.linalg.norm(np.linalg.inv(self.cell), axis=0)
        most = [int(np.ceil(reach / height)) + 1 for height in heights]
        for axis in self.walled_axes():
            most[axis] = 0
        return np.array(list(itertools.product(*(range(-m, m + 1) for m in most))))

    def neighbours(self, reach, x=None):
        """Returns (i, j, r) of all ordered pairs with a branch r up to `reach`, including pairs of a grain and its
        own images."""
        x = self.x if x is None else x
        parts = []
        for image in self.images(reach):
            r = x[None] + image @ self.cell - x[:, None]
            length = np.linalg.norm(r, axis=2)
            hit = (length <= reach) & (length > 0)
            i, j = np.nonzero(hit)
            parts.append((i, j, r[i, j]))
        return tuple(np.concatenate(columns) for columns in zip(*parts))


def parts_of(n, edges):
    """Returns the connected parts of a periodic graph: (grains, number of independent directions in which the part
    percolates).

    @param edges  (i, j, image) for each; grains without an edge are parts too
    """
    of = collections.defaultdict(list)
    for i, j, image in edges:
        of[i].append((j, np.asarray(image)))
        of[j].append((i, -np.asarray(image)))
    seen, out = {}, []
    for start in range(n):
        if start in seen:
            continue
        seen[start] = 0
        place, queue, windings = {start: np.zeros(len(edges[0][2]) if edges else 1, int)}, [start], []
        while queue:
            i = queue.pop()
            for j, image in of[i]:
                if j in place:
                    windings.append(place[i] + image - place[j])
                else:
                    place[j] = place[i] + image
                    seen[j] = 0
                    queue.append(j)
        loops = np.array([w for w in windings if w.any()])
        out.append((sorted(place), np.linalg.matrix_rank(loops) if len(loops) else 0, loops))
    return out
