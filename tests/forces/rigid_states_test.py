#!/usr/bin/env python3
"""Proves that the canonical forces of rigid spheres and polyhedra have the least elastic energy of all balanced forces.

    rigid_states_test.py --floc PROGRAM --source DIR

The forces f minimise sum |f|^2/2 under the balance A f = b and Coulomb's cones if motions y of the grains exist with
f = A^T y + z, where z is zero in each contact that sticks, and normal to f and to Coulomb's cone in each contact at
its limit. The balance is set up here from the contact points of the state file, and y is found by least squares, so
that only the forces come from floc.
"""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

BALANCED = 1e-10  # largest error of the balance, over the mean normal force
# Largest error of this condition, divided by the mean normal force.
OPTIMAL = 1e-10
AT_LIMIT = 1e-5   # share of Coulomb's limit


def balance(path):
    """Returns rows for the force and moment of each grain and for the normal stresses, with three columns (x, y, z)
    for each contact."""
    with h5py.File(path) as state:
        contacts, grains = state["contacts"], state["grains"]
        i, j = contacts["id1"][:], contacts["id2"][:]
        position, radius = grains["position"][:], grains["radius"][:]
        branch = position[j] + contacts["image"][:] @ state["cell/matrix"][:] - position[i]
        normal = contacts["normal"][:]
        if "point" in contacts:
            arm_i = contacts["point"][:]
        else:
            arm_i = (radius[i] / (radius[i] + radius[j]))[:, None] * branch
    arm_j = arm_i - branch
    n_grains = len(radius)
    matrix = np.zeros((6 * n_grains + 3, 3 * len(i)))
    for k in range(len(i)):
        for a in range(3):
            force = np.eye(3)[a]
            for body, sign, arm in ((j[k], 1.0, arm_j[k]), (i[k], -1.0, arm_i[k])):
                matrix[6 * body:6 * body + 3, 3 * k + a] += sign * force
                matrix[6 * body + 3:6 * body + 6, 3 * k + a] += sign * np.cross(arm, force)
            matrix[6 * n_grains + a, 3 * k + a] = branch[k, a]
    return matrix, normal


def check(floc, state, friction, directory):
    table = directory / "contacts.csv"
    # In a cell with fixed angles, the shear stresses are part of the load. floc takes them from the forces.
    subprocess.run([floc, "forces", str(state), "--selection", "canonical", "--contacts", str(table), "--format", "csv"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(table) as file:
        rows = list(csv.DictReader(file))
    matrix, normal = balance(state)
    shears = []
    n_grains = (len(matrix) - 3) // 6
    with h5py.File(state) as found:
        contacts = found["contacts"]
        branch = (found["grains/position"][:][contacts["id2"][:]] + contacts["image"][:] @ found["cell/matrix"][:]
                  - found["grains/position"][:][contacts["id1"][:]])
        stored = contacts["normal_force"][:][:, None] * contacts["normal"][:] - contacts["shear_force"][:]
    for a, b in ((1, 2), (0, 2), (0, 1)):
        row = np.zeros(matrix.shape[1])
        row[a::3], row[b::3] = 0.5 * branch[:, b], 0.5 * branch[:, a]
        shears.append(row)
    matrix = np.vstack([matrix, shears])
    normal_force = np.array([float(row["normal_force"]) for row in rows])
    on_i = np.array([[float(row[f"shear_force{a}"]) for a in (1, 2, 3)] for row in rows])
    force = (normal_force[:, None] * normal - on_i).ravel()  # on the second grain
    mean = normal_force.mean()
    load = matrix @ stored.ravel()
    load[:6 * n_grains] = 0.0
    unbalanced = np.abs(matrix @ force - load).max() / mean
    size = np.linalg.norm(on_i, axis=1)
    carries = normal_force > 1e-6 * mean
    capped = carries & (size > (1.0 - AT_LIMIT) * friction * normal_force)
    # In contacts at their limit, f = A^T y + alpha (mu n - t/|t|), where t is the tangential force on j.
    columns = [matrix.T]
    for k in np.flatnonzero(capped):
        column = np.zeros((len(force), 1))
        column[3 * k:3 * k + 3, 0] = friction * normal[k] + on_i[k] / size[k]
        columns.append(column)
    system = np.hstack(columns)
    kept = np.repeat(carries, 3)
    solution = np.linalg.lstsq(system[kept], force[kept], rcond=1e-10)[0]
    error = np.abs(system[kept] @ solution - force[kept]).max() / mean
    alpha = solution[matrix.shape[0]:]
    print(f"{state.parent.name}: {len(rows)} contacts, {capped.sum()} at their limit, {(~carries).sum()} without a force: "
          f"balance {unbalanced:.1e}, optimality {error:.1e}, least multiplier {alpha.min(initial=0.0) / mean:.1e}")
    if not (unbalanced < BALANCED and error < OPTIMAL and alpha.min(initial=0.0) > -OPTIMAL * mean):
        sys.exit("the canonical forces of floc are not those of least elastic energy")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    scenes = pathlib.Path(arguments.source) / "data/scenes"
    with tempfile.TemporaryDirectory() as directory:
        directory = pathlib.Path(directory)
        spheres = directory / "spheres.toml"
        text = (scenes / "polyhedra_demo.toml").read_text()
        spheres.write_text("\n".join(line for line in text.splitlines() if not line.startswith("shape = ")))
        for name, scene, count in (("spheres", spheres, 60), ("polyhedra", scenes / "polyhedra_demo.toml", 20)):
            run = directory / name
            subprocess.run([arguments.floc, "run", str(scene), "-o", str(run), "--set", f"grains.count={count}"],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            check(arguments.floc, run / "state-0000.h5", 0.5, directory)


if __name__ == "__main__":
    main()
