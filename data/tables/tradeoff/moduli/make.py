#!/usr/bin/env python3
"""Makes sizes.csv in this folder: time, memory and error of the methods of floc moduli against the number of grains.

A packing of a thousand grains is laid side by side in copies. The moduli of the copies are those of the packing, so
that the error of each method is known at every size.
"""

import argparse
import csv
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, os.pardir, os.pardir, os.pardir, "scenes")

# Kind of packing -> shipped scene, last equilibrium that is made of it, and keys that make this one cheap.
PACKINGS = {
    "disks-cohesionless": ("cohesionless_cycle", 2, []),
    "beads-hertz": ("spheres_demo", 1, ["load.0.to=1e6"]),
}
METHODS = [
    ("bounds", ["--method", "bounds"]),
    ("iterative 1e-2", ["--method", "iterative", "--tolerance", "1e-2"]),
    ("iterative 1e-6", ["--method", "iterative", "--tolerance", "1e-6"]),
    ("single-factor 1e-6", ["--method", "single-factor", "--tolerance", "1e-6"]),
    ("petsc 1e-6", ["--solver", "petsc", "--tolerance", "1e-6"]),
    ("factor 1e-10", ["--solver", "cholmod"]),
]
COLUMNS = ["kind", "n_grains", "method", "core_seconds", "memory_mb", "error", "error_bound"]


def measured(command, **options):
    """Runs a command. Returns its exit code, what it printed, its processor time (s) and its largest memory (MB)."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, env={**os.environ, "OMP_NUM_THREADS": "1"}, **options)
    text = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), text, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def required(command, **options):
    code, text, seconds, memory = measured(command, **options)
    if code != 0:
        sys.exit(f"{' '.join(command)}: exit code {code}")
    return text, seconds, memory


def moduli(floc, state, options):
    """Returns the row of floc moduli, with its processor time and memory; None where the method fails."""
    code, text, seconds, memory = measured([floc, "moduli", state, "--format", "csv", *options],
                                           stderr=subprocess.DEVNULL)
    rows = list(csv.DictReader(text.splitlines())) if code == 0 else []
    return (rows[0], seconds, memory) if rows else None


def last_state(folder):
    return os.path.join(folder, sorted(f for f in os.listdir(folder) if f.startswith("state-"))[-1])


def scene_of_copies(text, state, copies):
    """Returns a scene whose grains are copies of a state, from the text of the scene of the state."""
    sections = re.split(r"(?m)^(?=\[)", text)
    kept = [s for s in sections if not s.startswith(("[grains", "[assembly", "[[load"))]
    kept = re.sub(r"(?m)^solid_fraction.*\n", "", "".join(kept))
    return kept + f"\n[assembly]\nprotocol = \"state\"\nstate = \"{state}\"\ncopies = {copies}\n"


def tiled(floc, kind, state, copies, dimension, folder):
    """Lays copies of a state side by side along each axis, in equilibrium under the same pressure."""
    with open(os.path.join(SCENES, PACKINGS[kind][0] + ".toml"), encoding="utf-8") as shipped:
        text = scene_of_copies(shipped.read(), state, [copies] * dimension)
    scene = os.path.join(folder, f"{kind}-{copies}.toml")
    with open(scene, "w", encoding="utf-8") as out:
        out.write(text)
    required([floc, "run", scene, "-o", scene[:-5]], stderr=subprocess.DEVNULL)
    return last_state(scene[:-5])


def rows_of(floc, kind, most, folder):
    scene, last, changes = PACKINGS[kind]
    out = os.path.join(folder, kind)
    command = [floc, "run", os.path.join(SCENES, scene + ".toml"), "-o", out, "--until", str(last),
               "--set", "grains.count=1000"]
    for change in changes:
        command += ["--set", change]
    required(command, stderr=subprocess.DEVNULL)
    state = last_state(out)
    truth, _, _ = moduli(floc, state, ["--solver", "cholmod"])
    dimension = int(truth["dimension"])
    copies = 1
    while 1000 * copies ** dimension <= most:
        copied = state if copies == 1 else tiled(floc, kind, state, copies, dimension, folder)
        for method, options in METHODS:
            found = moduli(floc, copied, options)
            if not found:
                continue
            row, seconds, memory = found
            yield {"kind": kind, "n_grains": 1000 * copies ** dimension, "method": method,
                   "core_seconds": f"{seconds:.3g}", "memory_mb": f"{memory:.4g}",
                   "error": f"{abs(float(row['B']) / float(truth['B']) - 1):.3g}",
                   "error_bound": f"{float(row['error_B']) / float(row['B']):.3g}"}
        copies *= 2


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", default="floc", help="program [floc]")
    parser.add_argument("--only", choices=sorted(PACKINGS), help="kind of packing [all]")
    parser.add_argument("--most", type=int, default=100000, help="largest number of grains [100000]")
    parser.add_argument("-o", "--output", default=os.path.join(HERE, "sizes.csv"), help="table to write [sizes.csv here]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, open(options.output, "w", encoding="utf-8", newline="") as out:
        table = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        table.writeheader()
        for kind in [options.only] if options.only else PACKINGS:
            for row in rows_of(options.floc, kind, options.most, folder):
                table.writerow(row)
                out.flush()
                print(",".join(str(v) for v in row.values()), flush=True)


if __name__ == "__main__":
    main()
