#!/usr/bin/env python3
"""Wet spheres over water content and the friction they were put together with: a row a sample and state.

  scan.py FLOC DIRECTORY [--scene FILE] [--count N] [--seeds A..B] [--water W,...] [--friction MU,...] [--set KEY=VALUE ...]

runs data/scenes/wet_spheres.toml at each friction of the assembly up to the dry state, and from that, at each water
content, its two stages with liquid: P = 0, then the pressure of the assembly. Runs that are there already are resumed or
kept. Writes DIRECTORY/states.csv with what floc network --with bonds phases --exponents says of the three states.
"""
import argparse
import csv
import io
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "..", "scenes", "wet_spheres.toml")
COLUMNS = ["n_grains", "phi", "z", "z_bonds", "z_bonds_plus", "z_bonds_minus", "z_bonds_near_zero", "minus_share", "mean_plus",
           "mean_minus", "p0", "virial_strength", "rumpf_strength", "like_share", "like_share_shuffled",
           "like_share_shuffled_stddev", "positive_directions", "negative_directions", "positive_directions_shuffled",
           "negative_directions_shuffled", "positive_largest_cluster", "negative_largest_cluster", "positive_clusters",
           "negative_clusters", "pressed_share", "stress_spread"]
# Exponents of forces over f0 and of particle pressures over p0, on either side, from zero and from a tenth.
EXPONENTS = [(quantity, side, start) for quantity in ("force", "pressure") for start in ("0", "0.1") for side in "+-"]


def numbers(text):
    return [float(part) for part in text.split(",")]


def seeds(text):
    first, _, last = text.partition("..")
    return range(int(first), int(last or first) + 1)


def run(command):
    """Whether the run made all its states; what stopped it is said."""
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        print(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip().splitlines()[-1]}", file=sys.stderr)
    return done.returncode == 0


def wet_scene(dry, state):
    """The scene whose grains come from a saved state instead of a gas."""
    scene = re.sub(r'protocol = "direct".*', f'protocol = "state"\nstate = "{state}"', dry)
    # What the grains were put together with is over: they are under the law of the stages.
    scene = re.sub(r"(?m)^(?:solid_fraction|friction|inertial_number_cap) = [\d.].*\n", "", scene)
    # Those that are to come to rest do so in a fraction of this.
    scene = scene.replace("[equilibrium]\n", "[equilibrium]\nmax_time = 60\n")
    return re.sub(r"(?ms)^\[grains\].*?(?=^\[)", "", scene)


def exponents(file, units, with_liquid):
    """Of one state, by quantity, side and start, with standard errors.

    units: f0 and p0 by quantity; filled from a state with liquid. Without liquid, exponents from zero are converted from
    those over the mean, and there are no others.
    """
    found = {}
    for row in csv.DictReader(open(file)):
        key = row["quantity"], row["side"], row["from"]
        if not row["exponent"]:
            continue
        # Of the windows of a start the widest comes first.
        if with_liquid and row["unit"] in ("F0", "p0"):
            units[row["quantity"]] = float(row["unit_size"])
            found.setdefault(key, (row["exponent"], row["stderr"]))
        elif not with_liquid and row["unit"] == "mean" and row["from"] == "0":
            ratio = units[row["quantity"]] / float(row["unit_size"])
            found.setdefault(key, [f"{float(row[name]) * ratio:.6g}" for name in ("exponent", "stderr")])
    return [part for key in EXPONENTS for part in found.get(key, ("", ""))]


def measure(floc, state, units, with_liquid):
    table = os.path.join(os.path.dirname(state), "exponents.csv")
    out = subprocess.run([floc, "network", state, "--with", "bonds,phases", "--without", "mechanics", "--exponents", table,
                          "--format", "csv"],
                         capture_output=True, text=True, check=True).stdout
    row = next(csv.DictReader(io.StringIO(out)))
    return [row[c] for c in COLUMNS] + exponents(table, units, with_liquid)


def seconds_of(directory, steps):
    rows = list(csv.DictReader(open(os.path.join(directory, "path.csv"))))
    return sum(float(rows[k]["seconds"]) for k in steps)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--scene", default=SCENE)
    parser.add_argument("--count", type=int, default=8000)
    parser.add_argument("--seeds", type=seeds, default=range(1, 4))
    parser.add_argument("--water", type=numbers, default=[0.0035, 0.007, 0.014])
    parser.add_argument("--friction", type=numbers, default=[0.0, 0.4])
    parser.add_argument("--set", action="append", default=[], dest="changes")
    options = parser.parse_args()
    floc, top = os.path.abspath(options.floc), os.path.abspath(options.directory)
    os.makedirs(top, exist_ok=True)
    dry_scene = open(options.scene).read()
    changes = [word for change in options.changes for word in ("--set", change)]
    with open(os.path.join(top, "states.csv"), "w", newline="") as file:
        table = csv.writer(file)
        names = [f"{q}_exponent_{'plus' if s == '+' else 'minus'}_from_{start}" for q, s, start in EXPONENTS]
        table.writerow(["friction", "water", "state", "seed"] + COLUMNS
                       + [part for name in names for part in (name, name + "_stderr")] + ["seconds"])

        units = {}

        def add(friction, water, name, seed, directory, step):
            state = os.path.join(directory, f"state-{step:04d}.h5")
            table.writerow([friction, water, name, seed] + measure(floc, state, units, water > 0)
                           + [f"{seconds_of(directory, [step]):.1f}"])
            file.flush()
            print(f"mu {friction:g}, w {water:g}, seed {seed}: {name}", flush=True)

        for seed in options.seeds:
            for friction in options.friction:
                dry = os.path.join(top, f"mu{friction:g}-{seed}", "dry")
                run([floc, "run", options.scene, "-o", dry, "--seed", str(seed), "--threads", "1", "--resume", "--until", "0",
                     "--set", f"grains.count={options.count}", "--set", f"assembly.friction={friction:g}"] + changes)
                for water in options.water:
                    wet = os.path.join(top, f"mu{friction:g}-{seed}", f"w{water:g}")
                    scene = wet + ".toml"
                    text = re.sub(r"(adhesion\.water_content = )[\d.e-]+", rf"\g<1>{water:g}",
                                  wet_scene(dry_scene, "dry/state-0000.h5"))
                    if not os.path.exists(scene) or open(scene).read() != text:
                        os.makedirs(os.path.dirname(scene), exist_ok=True)
                        open(scene, "w").write(text)
                    if not run([floc, "run", scene, "-o", wet, "--seed", str(seed), "--threads", "1", "--resume"] + changes):
                        continue
                    for step, name in ((1, "P = 0"), (2, "loaded")):
                        add(friction, water, name, seed, wet, step)
                add(friction, 0.0, "dry", seed, dry, 0)


if __name__ == "__main__":
    main()
