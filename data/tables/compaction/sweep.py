#!/usr/bin/env python3
"""Dynamic compaction of sticky spheres over stiffness, pressure and adhesion: a row a run, for floc fit
dynamic-compaction.

  sweep.py FLOC DIRECTORY [--count N] [--seeds A..B] [--p P,...] [--se SE,...] [--eta-star X,...] [--set KEY=VALUE ...]

runs data/scenes/compaction_demo.toml with N spheres at each p, se and eta* (adhesion sc = eta* sqrt(p se), at most 0.1
se), each in a directory of its own, one after the other; runs that are there already are resumed or kept. Writes
DIRECTORY/points.csv. Pressures are in the unit of the kinetic pressure of the scene (the published one in MPa).
"""
import argparse
import csv
import math
import os
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "..", "scenes", "compaction_demo.toml")
COLUMNS = ["e", "p", "sc", "se", "eta", "eta_star", "N", "seed", "z", "z_wall", "z_minus", "x0", "n_wall_contacts",
           "p_friction", "kinetic_over_elastic", "n_mechanisms", "ending", "T", "seconds"]


def numbers(text):
    return [float(part) for part in text.split(",")]


def seeds(text):
    first, _, last = text.partition("..")
    return range(int(first), int(last or first) + 1)


def run(floc, directory, count, seed, p, se, sc, changes):
    """The last row of path.csv of a run, made where it is not there; None where it gave up."""
    table = os.path.join(directory, "path.csv")
    settings = {"grains.count": count, "box.pressure": p, "contact.normal.stiffness": se,
                "contact.friction.stiffness": 1.5 * se, "contact.adhesion.force": sc}
    command = [floc, "run", SCENE, "-o", directory, "--seed", str(seed), "--threads", "1", "--resume"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value!r}" if isinstance(value, float) else f"{key}={value}"]
    for change in changes:
        command += ["--set", change]
    if subprocess.run(command, stderr=subprocess.DEVNULL).returncode != 0:
        return None
    with open(table) as file:
        return list(csv.DictReader(file))[-1]


def point(row, count, seed, p, se, sc):
    borne = [float(row[f"p_friction_{a}"]) for a in (1, 2, 3)]
    return [row["void_ratio"], p, sc, se, sc / p, sc / math.sqrt(p * se), count, seed, row["z"], row["z_wall"],
            row["z_minus"], row["x0"], row["n_wall_contacts"], sum(borne) / 3 / p, row["kinetic_over_elastic"],
            row["n_mechanisms"], row["ending"], float(row["time"]) * math.sqrt(p), row["seconds"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--count", type=int, default=4000)
    parser.add_argument("--seeds", type=seeds, default=range(1, 2))
    parser.add_argument("--p", type=numbers, default=[0.01, 0.1, 0.5, 1.0])
    parser.add_argument("--se", type=numbers, default=[500.0, 2000.0, 1e4, 5e4, 2e5])
    parser.add_argument("--eta-star", type=numbers,
                        default=[1e-4, 1e-3, 0.003, 0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 2.0, 15.0])
    parser.add_argument("--set", action="append", default=[], dest="changes")
    options = parser.parse_args()
    os.makedirs(options.directory, exist_ok=True)
    began = time.time()
    with open(os.path.join(options.directory, "points.csv"), "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for se in options.se:
            for p in options.p:
                for eta_star in options.eta_star:
                    sc = eta_star * math.sqrt(p * se)
                    if sc > 0.1 * se:
                        continue
                    for seed in options.seeds:
                        name = f"p{p:g}-se{se:g}-eta{eta_star:g}-N{options.count}-{seed}"
                        row = run(os.path.abspath(options.floc), os.path.join(options.directory, name), options.count,
                                  seed, p, se, sc, options.changes)
                        if row is None:
                            print(f"{name}: no state", file=sys.stderr)
                            continue
                        table.writerow(point(row, options.count, seed, p, se, sc))
                        file.flush()
                        print(f"{name}: e = {row['void_ratio']}, {row['ending']}, {time.time() - began:.0f} s", flush=True)


if __name__ == "__main__":
    main()
