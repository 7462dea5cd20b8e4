#!/usr/bin/env python3
"""Compares time steps of spheres and polyhedra with Siconos.

    siconos_test.py --floc PROGRAM --source DIR

The impulses r of a time step of rigid grains with friction solve Signorini's and Coulomb's conditions for the relative
velocities W r + q at its end. Siconos has this problem as `FrictionContactProblem`, and an error of its own for solutions of
it. W and q are put together here from the state file. A state in motion holds the forces of the step that begins at it. The
forces of a state at rest are those of a step after which nothing moves. Siconos also solves the steps from the start,
without the forces of floc: the velocities at the end are compared, since forces are one set of many. For the polyhedra at
rest alone it finds another solution, in which they move: Coulomb's problem may have several. Exit code 77: Siconos is missing.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

try:
    import siconos.numerics as siconos
except ImportError:
    sys.exit(77)

FRICTION = 0.5
AT_REST = 1e-9    # largest error of a state at rest by Siconos' measure
COARSEST = 1e-7   # largest error that floc may record of a step in motion; Siconos may find ten times as much
SOLVED = 1e-10    # error by the same measure at which Siconos' own solution ends
SAME_MOTION = 1e-6    # difference of velocities that its end leaves, over the largest one without contacts
SWEEPS = 1_000_000
STABILISATION = 0.1   # share of an overlap that a step in motion removes


def rotation(quaternion):
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Step:
    """Time step that begins at a state: masses, velocities without contacts, and contacts with their impulses.

    A state at rest begins a step of one unit of time, with the masses that a side of the cell has by default."""

    def __init__(self, path):
        with h5py.File(path) as state:
            grains, contacts = state["grains"], state["contacts"]
            motion = dict(state["motion"].attrs) if "motion" in state else None
            cell, self.pressure = state["cell/matrix"][:], state["equilibrium/target"][:]
            position, radius, mass = grains["position"][:], grains["radius"][:], grains["mass"][:]
            rate = np.linalg.solve(cell, state["cell/velocity"][:]).T if motion else np.zeros((3, 3))
            inertia = self.inertia(state, mass, radius)
            self.i, self.j = contacts["id1"][:], contacts["id2"][:]
            branch = position[self.j] + contacts["image"][:] @ cell - position[self.i]
            normal, gap = contacts["normal"][:], contacts["gap"][:]
            arm = contacts["point"][:] if "point" in contacts else self.midway(radius, branch, normal)
            force = contacts["normal_force"][:][:, None] * normal - contacts["shear_force"][:]
            strained = state["equilibrium/target_side"][:] > 0 if motion else np.zeros(3, bool)
            velocity = np.hstack([grains["velocity"][:], grains["angular_velocity"][:]]) if motion else np.zeros((len(mass), 6))
        self.dt = motion["time_step"] if motion else 1.0
        self.residual = motion["residual"] if motion else 0.0
        self.n = len(self.i)
        self.frame = np.array([np.linalg.svd(n[None])[2].T for n in normal])
        self.frame[:, :, 0] = normal
        side_mass = (motion["cell_mass"] if motion else 1.0) * mass.sum() * np.diag(cell) ** 2
        free = ~strained
        volume = abs(np.linalg.det(cell))
        stretch = np.diag(rate) - np.where(free, self.dt * volume * self.pressure / side_mass, 0.0)
        # Columns of the Jacobian: six for each grain, then the stretches of the cell.
        unknowns = 6 * len(mass) + 3
        self.jacobian = np.zeros((3 * self.n, unknowns))
        inverse_mass = np.zeros((unknowns, unknowns))
        for g in range(len(mass)):
            inverse_mass[6 * g:6 * g + 3, 6 * g:6 * g + 3] = np.eye(3) / mass[g]
            inverse_mass[6 * g + 3:6 * g + 6, 6 * g + 3:6 * g + 6] = np.linalg.inv(inertia[g])
        inverse_mass[-3:, -3:] = np.diag(free / side_mass)
        bias = np.zeros((self.n, 3))
        for k in range(self.n):
            to_frame = self.frame[k].T
            rows = self.jacobian[3 * k:3 * k + 3]
            for body, sign, lever in ((self.j[k], 1.0, arm[k] - branch[k]), (self.i[k], -1.0, arm[k])):
                rows[:, 6 * body:6 * body + 3] += sign * to_frame
                rows[:, 6 * body + 3:6 * body + 6] += sign * to_frame @ np.cross(np.eye(3), lever).T
            rows[:, -3:] = to_frame * branch[k]
            bias[k] = to_frame @ ((rate - np.diag(np.diag(rate))) @ branch[k])
            if motion:
                bias[k, 0] += gap[k] / self.dt * (1.0 if gap[k] > 0 else STABILISATION)
        for moments, spin in zip(inertia, velocity[:, 3:]):
            spin -= self.dt * np.linalg.solve(moments, np.cross(spin, moments @ spin))  # Euler's equations
        self.free = np.concatenate([velocity.ravel(), stretch])
        self.matrix = self.jacobian @ inverse_mass @ self.jacobian.T
        self.offset = self.jacobian @ self.free + bias.ravel()
        self.impulse = self.dt * np.einsum("kab,ka->kb", self.frame, force).ravel()

    @staticmethod
    def inertia(state, mass, radius):
        if "shapes" not in state:
            return [0.4 * m * r * r * np.eye(3) for m, r in zip(mass, radius)]
        shape, scale = state["grains/shape"][:], state["grains/scale"][:]
        volume, moments = state["shapes/volume"][:], state["shapes/inertia"][:]
        turned = [rotation(q) for q in state["grains/orientation"][:]]
        return [m / volume[s] * a * a * t @ np.diag(moments[s]) @ t.T for m, s, a, t in zip(mass, shape, scale, turned)]

    def midway(self, radius, branch, normal):
        distance = np.linalg.norm(branch, axis=1)
        return (radius[self.i] / (radius[self.i] + radius[self.j]) * distance)[:, None] * normal

    def problem(self):
        return siconos.FrictionContactProblem(3, self.n, self.matrix, self.offset, np.full(self.n, FRICTION))

    def error(self, impulse):
        """Siconos' error of impulses, over the velocities without contacts, and the velocities that they lead to."""
        options = siconos.SolverOptions(siconos.SICONOS_FRICTION_3D_NSGS)
        velocity = np.zeros(3 * self.n)
        error = siconos.fc3d_compute_error(self.problem(), impulse.copy(), velocity, SOLVED, options,
                                           np.linalg.norm(self.offset))[1]
        return error, velocity

    def solution(self):
        """Impulses that Siconos finds, starting from none."""
        options = siconos.SolverOptions(siconos.SICONOS_FRICTION_3D_NSGS)
        options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = SWEEPS
        options.dparam[siconos.SICONOS_DPARAM_TOL] = SOLVED
        impulse, velocity = np.zeros(3 * self.n), np.zeros(3 * self.n)
        if siconos.fc3d_driver(self.problem(), impulse, velocity, options) != 0:
            sys.exit(f"Siconos does not solve the step: error {options.dparam[siconos.SICONOS_DPARAM_RESIDU]:.1e}")
        return impulse


def compare(name, step, tolerance, solves):
    own, velocity = step.error(step.impulse)
    wrong, _ = step.error(step.impulse * np.tile([1.0, 1.01, 1.01], step.n))
    print(f"{name}: {step.n} contacts; error by Siconos {own:.1e}, with tangential forces 1 % larger {wrong:.1e}")
    if not (own < tolerance and wrong > 10.0 * own):
        sys.exit(f"{name}: the time step of floc does not solve Siconos' problem to {tolerance:.1e}")
    if not solves:
        return
    other = step.solution()
    differs = np.abs(velocity - step.error(other)[1]).max() / np.abs(step.offset).max()
    moved = np.linalg.norm(other - step.impulse) / np.linalg.norm(step.impulse)
    print(f"  from Siconos' own solution the velocities differ by {differs:.1e}, the forces by {moved:.1e}")
    if not differs < max(SAME_MOTION, 10.0 * tolerance):
        sys.exit(f"{name}: floc and Siconos find different motions")


def compare_run(name, run):
    compare(f"{name} at rest", Step(run / "state-0000.h5"), AT_REST, name == "spheres")
    for state in (1, 2, 3):
        step = Step(run / f"state-{state:04d}.h5")
        print(f"{name} in motion {state}: floc records the error {step.residual:.1e}")
        if not step.residual < COARSEST:
            sys.exit(f"{name}: floc solves the step in motion too coarsely for a comparison")
        compare(f"{name} in motion {state}", step, 10.0 * step.residual, state == 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    polyhedra = (pathlib.Path(arguments.source) / "data/scenes/polyhedra_demo.toml").read_text()
    spheres = "\n".join(line for line in polyhedra.splitlines() if not line.startswith("shape = "))
    shear = '\n[[load]]\nname = "shear"\ncontrol = "simple_shear"\nstrain = 0.06\nsteps = 3\ninertial_number = 0.05\n'
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        for name, text, count in (("spheres", spheres, 40), ("polyhedra", polyhedra, 20)):
            scene, run = directory / f"{name}.toml", directory / name
            scene.write_text(text + shear)
            settings = (f"grains.count={count}", "dynamics.sweep_tolerance=1e-8", "dynamics.max_sweeps=40000")
            subprocess.run([arguments.floc, "run", str(scene), "-o", str(run), *(w for s in settings for w in ("--set", s))],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            compare_run(name, run)


if __name__ == "__main__":
    main()
