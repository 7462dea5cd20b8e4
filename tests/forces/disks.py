"""Packings of disks made by floc, and the balance of their forces, set up without code of floc."""
import csv
import pathlib
import subprocess

import h5py
import numpy as np


class Program:
    """The program, with a directory for scenes."""

    def __init__(self, floc, source, directory):
        self.floc, self.directory = floc, pathlib.Path(directory)
        shipped = pathlib.Path(source) / "data/scenes/cohesionless_cycle.toml"
        lines = shipped.read_text().splitlines()
        self.scene = self.directory / "scene.toml"
        self.scene.write_text("\n".join(line for line in lines if not line.startswith("rolling = ")))

    def state(self, name, settings):
        """Makes the first equilibrium of the scene of cohesionless disks without rolling resistance, after changing
        the given keys."""
        changes = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        run = self.directory / name
        subprocess.run([self.floc, "run", str(self.scene), "-o", str(run), "--until", "0", *changes], check=True,
                       stderr=subprocess.DEVNULL)
        return run / "state-0000.h5"

    def forces(self, state, *options):
        """Returns the row of `floc forces` and the rows of its contacts, as dictionaries of texts."""
        table = self.directory / "contacts.csv"
        done = subprocess.run([self.floc, "forces", str(state), "--contacts", str(table), "--format", "csv", *options],
                              check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        with open(table) as file:
            return next(csv.DictReader(done.stdout.splitlines())), list(csv.DictReader(file))


class Balance:
    """Returns the balance of the disks of a state: rows for forces and moments, then for the stress; columns P and T
    for each contact."""

    def __init__(self, path):
        with h5py.File(path) as state:
            contacts, grains = state["contacts"], state["grains"]
            i, j = contacts["id1"][:], contacts["id2"][:]
            radius, position = grains["radius"][:], grains["position"][:]
            branch = position[j] + contacts["image"][:] @ state["cell/matrix"][:] - position[i]
            shear, normal_force = contacts["shear_force"][:], contacts["normal_force"][:]
        distance = np.linalg.norm(branch, axis=1)
        normal = branch / distance[:, None]
        tangent = np.column_stack([-normal[:, 1], normal[:, 0]])
        arm_i = (radius[i] / (radius[i] + radius[j]) * distance)[:, None] * normal
        arm_j = arm_i - branch
        self.n = len(i)
        matrix = np.zeros((3 * len(radius) + 3, 2 * self.n))
        for k in range(self.n):
            for column, direction in ((2 * k, normal[k]), (2 * k + 1, tangent[k])):
                # A unit force on j along the direction, and the opposite force on i.
                for body, sign, arm in ((j[k], 1.0, arm_j[k]), (i[k], -1.0, arm_i[k])):
                    matrix[3 * body, column] += sign * direction[0]
                    matrix[3 * body + 1, column] += sign * direction[1]
                    matrix[3 * body + 2, column] += sign * (arm[0] * direction[1] - arm[1] * direction[0])
                for row, (a, b) in enumerate(((0, 0), (1, 1), (0, 1))):
                    matrix[3 * len(radius) + row, column] = (
                        0.5 * (direction[a] * branch[k, b] + direction[b] * branch[k, a]))
        self.matrix = matrix
        self.tangent = tangent
        self.forces = self.components(normal_force, shear)
        self.unit = normal_force.mean()
        self.load = self.matrix @ self.forces / self.unit
        self.load[:3 * len(radius)] = 0.0

    def components(self, normal_force, shear):
        """Returns P and T of each contact of a state. floc lists the tangential force on i."""
        return np.column_stack([normal_force, -np.einsum("ka,ka->k", shear, self.tangent)]).ravel()

    def listed(self, rows):
        """Returns P and T of each contact from the rows of a table of contacts."""
        normal_force = np.array([float(row["normal_force"]) for row in rows])
        shear = np.array([[float(row["shear_force1"]), float(row["shear_force2"])] for row in rows])
        return self.components(normal_force, shear)
