#!/usr/bin/env python3
"""Glass beads of Agnolin and Roux: a row a state.

  study.py FLOC DIRECTORY states|choices [--count N] [--seeds A..B] [--jobs J]

states runs data/scenes/spheres_a, a0, b, c and d.toml with N beads, from the gas to 100 MPa and back, and writes
DIRECTORY/states_N.csv. choices puts the beads of a, b and d together with other values of what the papers leave open, loads
nothing, and writes DIRECTORY/choices_N.csv. Runs that are there already are resumed or kept.
"""
import argparse
import csv
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "scenes")
COLUMNS = ["phi", "z_carrying", "z_star_carrying", "x0_carrying", "x2", "z_star_star", "hyperstaticity", "Z_1_3", "Z_2",
           "M1_carrying", "M2_carrying", "sliding_share", "energy_per_grain", "p_max"]
CAPS = {"a": 1e-3, "b": 1e-3, "d": 0.1}  # of the scenes, on the strain rate while beads are put together


def choices(state):
    """Names of other choices, and what they set: speed of the gas, cap a third and three times as high, lighter cell."""
    return {"v05": "assembly.agitation=0.5", "I1": f"assembly.inertial_number_cap={CAPS[state] / 3.0:.4g}",
            "I2": f"assembly.inertial_number_cap={CAPS[state] * 3.0:.4g}", "M": "cell.mass=0.1"}


def output_of(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command[:4])}: {done.stderr.strip().splitlines()[-1]}")
    return done.stdout


def run(arguments, scene, name, *settings):
    """Directories of the samples of a scene, made where they are not there."""
    directory = os.path.join(arguments.directory, f"{name}_{arguments.count}")
    output_of([arguments.floc, "run", scene, "-o", directory, "--set", f"grains.count={arguments.count}",
               "--seeds", arguments.seeds, "--jobs", str(arguments.jobs), "--threads", "1", "--resume", *settings])
    first, _, last = arguments.seeds.partition("..")
    return {seed: os.path.join(directory, f"seed-{seed}") for seed in range(int(first), int(last or first) + 1)}


def rows(floc, sample):
    """Rows of path.csv and of floc network, of the states of a sample."""
    with open(os.path.join(sample, "path.csv")) as file:
        path = list(csv.DictReader(file))
    states = [os.path.join(sample, row["state"]) for row in path]
    table = output_of([floc, "network", "--zero-force", "1e-4", "--format", "csv", "--columns", ",".join(COLUMNS), *states])
    return zip(path, csv.DictReader(table.splitlines()))


def without_loads(scene, directory):
    with open(scene) as file:
        text = file.read()
    shortened = os.path.join(directory, os.path.basename(scene))
    with open(shortened, "w") as file:
        file.write(text[:text.index("[[load]]")] + text[text.index("[equilibrium]"):])
    return shortened


def state_rows(arguments):
    for state in ("a", "a0", "b", "c", "d"):
        samples = run(arguments, os.path.join(SCENES, f"spheres_{state}.toml"), state)
        for seed, sample in samples.items():
            for path, network in rows(arguments.floc, sample):
                yield {"state": state, "seed": seed, **{name: path[name] for name in ("step", "branch", "P")}, **network}


def choice_rows(arguments):
    for state in CAPS:
        scene = without_loads(os.path.join(SCENES, f"spheres_{state}.toml"), arguments.directory)
        for choice, setting in choices(state).items():
            for seed, sample in run(arguments, scene, f"{state}_{choice}", "--set", setting).items():
                for _, network in rows(arguments.floc, sample):
                    yield {"state": state, "choice": choice, "seed": seed, **network}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("study", choices=["states", "choices"])
    parser.add_argument("--count", type=int, default=4000)
    parser.add_argument("--seeds", default="1..5")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    os.makedirs(arguments.directory, exist_ok=True)
    found = list({"states": state_rows, "choices": choice_rows}[arguments.study](arguments))
    with open(os.path.join(arguments.directory, f"{arguments.study}_{arguments.count}.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)


if __name__ == "__main__":
    main()
