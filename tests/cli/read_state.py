"""Recomputes gaps, net forces and stress of a state file with h5py and numpy, as docs/states.md describes them, and
compares them with the numbers in the file. Uses no code of floc.

Usage: read_state.py STATE [largest net force allowed, in units of the largest contact force]
"""

import sys

import h5py
import numpy as np


def check(name, found, stated, tolerance):
    error = np.max(np.abs(np.asarray(found) - np.asarray(stated)), initial=0.0)
    if not error <= tolerance:
        sys.exit(f"{name}: recomputed and stated differ by {error}, allowed {tolerance}")


def main(path, net_force_allowed):
    with h5py.File(path, "r") as f:
        assert f.attrs["format"] == "floc-state" and f.attrs["sign_convention"] == "compression_positive"
        dim = int(f.attrs["dimension"])
        cell = f["cell/matrix"][:]
        x = f["grains/position"][:]
        radius = f["grains/radius"][:]
        c = {name: dataset[:] for name, dataset in f["contacts"].items() if name != "memory"}
        law = dict(f["law"].attrs)
        stress_stated = f["equilibrium/stress"][:]
        for group in ("cell", "grains", "contacts", "equilibrium"):
            for dataset in f[group].values():
                if isinstance(dataset, h5py.Group):
                    continue
                assert "units" in dataset.attrs, dataset.name

    n = len(radius)
    branch = x[c["id2"]] + c["image"] @ cell - x[c["id1"]]
    distance = np.linalg.norm(branch, axis=1)
    gap = distance - radius[c["id1"]] - radius[c["id2"]]
    normal = branch / distance[:, None]
    rounding = 64 * np.finfo(float).eps * (np.abs(cell).sum() + 2 * radius.max())
    check("gap", gap, c["gap"], rounding)
    check("normal", normal, c["normal"], rounding / distance.min())

    # Static normal force of the law, computed from the gap alone.
    elastic = np.where(gap < 0, -law["normal_stiffness"] * gap, 0.0)
    adhesive = np.zeros_like(gap)
    if law["adhesion"] != "none":
        reach = law["adhesion_range"]
        tail = np.where(gap < reach, 1 - gap / reach, 0.0) if reach > 0 else np.zeros_like(gap)
        adhesive = -law["adhesion_force"] * np.where(gap < 0, 1.0, tail)
    steepest = law["normal_stiffness"]
    if law["adhesion"] == "tail":
        steepest = max(steepest, law["adhesion_force"] / law["adhesion_range"])
    force_rounding = steepest * rounding + 1e-12 * np.max(np.abs(elastic), initial=0.0)
    check("normal_force", elastic + adhesive, c["normal_force"], force_rounding)
    check("elastic_force", elastic, c["elastic_force"], force_rounding)

    on_first = c["shear_force"] - (elastic + adhesive)[:, None] * normal
    net = np.zeros((n, dim))
    np.add.at(net, c["id1"], on_first)
    np.add.at(net, c["id2"], -on_first)
    largest = np.max(np.abs(elastic), initial=0.0)
    worst = np.linalg.norm(net, axis=1).max()
    if worst > net_force_allowed * largest:
        sys.exit(f"net force: {worst}, largest contact force {largest}")

    stress = -(on_first.T @ branch) / abs(np.linalg.det(cell))
    check("stress", stress, stress_stated, 1e-9 * np.abs(stress_stated).max() + force_rounding * n)
    print(f"{n} grains, {len(gap)} contacts, largest net force {worst}, stress {stress.tolist()}")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else np.inf)
