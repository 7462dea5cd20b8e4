"""Compares runs of floc: two runs bit for bit, or the means of two ensembles. Uses no code of floc.

  compare_runs.py RUN_A RUN_B [--residuals T]

Bit for bit: compares every dataset of every state-NNNN.h5 (cell, grains, contacts with their histories, equilibrium),
and path.csv without the column `seconds`. Prints one line for each state that differs: the first differing dataset,
and the size of the difference. Exit code 0 if nothing differs, 1 if something differs, 2 if a directory contains no
run. Attributes (version, law, provenance) and the texts `scene` and `progress` are not compared. State files of
versions 1 and 2 are equal if they contain equal numbers. With --residuals, residuals (in units of F1) that differ by
at most T count as equal, because sums of forces that cancel are only rounding, which depends on the order of
operations. The number of such residuals is printed.

  compare_runs.py --means A/seed-* --against B/seed-*

Means: if arithmetic was changed on purpose, samples differ, but their means must agree. Each sample of A is paired
with the sample of B whose directory has the same name (the same seed). Prints for each step the mean of B - A, its
standard error and Student's t = difference / error with n - 1 degrees of freedom, for phi and z (columns of
path.csv), ln B and ln G (of DIR/moduli.csv, made by `floc moduli DIR/state-*.h5 --format csv > DIR/moduli.csv`; left
out if this file is missing). The last line gives the largest |t|; among twenty numbers, one beyond the 5 % bound is
to be expected. Exit code 0 for any t, 2 if the samples cannot be paired.
"""

import argparse
import csv
import math
import os
import sys

import h5py
import numpy as np

GROUPS = ("cell", "grains", "contacts", "equilibrium")
# Names of datasets in version 1 and in version 2.
RENAMED = {
    "contacts/shear_spring": "contacts/memory/shear_spring",
    "contacts/rolling_spring": "contacts/memory/rolling_spring",
}


class BadInput(Exception):
    """Directories that cannot be compared; the message says why."""


def datasets(path):
    """Returns all arrays of a state file by their names in version 2."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and name.split("/")[0] in GROUPS:
            found[RENAMED.get(name, name)] = item[()]

    with h5py.File(path, "r") as f:
        f.visititems(visit)
    return found


def in_order(names):
    """Sorts names, cell and positions first, because these show soonest where two paths separate."""
    return sorted(names, key=lambda name: (GROUPS.index(name.split("/")[0]), name != "grains/position", name))


def may_be_absent(name):
    """Returns whether a missing array means zeros: histories, or second parts of positions."""
    return name.startswith("contacts/memory/") or name == "grains/position_low"


class Residuals:
    """Compares residuals within a tolerance for rounding, and counts those that differ."""

    def __init__(self, tolerance):
        self.tolerance = tolerance
        self.n_moved = 0

    def same(self, a, b):
        """Returns whether two residuals count as equal."""
        within = bool(np.all(np.abs(np.asarray(a, float) - np.asarray(b, float)) <= self.tolerance))
        self.n_moved += within and bool(np.any(np.asarray(a, float) != np.asarray(b, float)))
        return within


def how_numbers_differ(a, b):
    """Describes the difference of two arrays; None if they have the same bits."""
    if a is None or b is None:
        return f"is missing in {'the first' if a is None else 'the second'}"
    if a.shape != b.shape:
        return f"has shape {a.shape} against {b.shape}"
    if a.dtype != b.dtype:
        return f"is stored as {a.dtype} against {b.dtype}"
    if a.tobytes() == b.tobytes():
        return None
    a, b = np.atleast_1d(a).astype(float), np.atleast_1d(b).astype(float)
    with np.errstate(invalid="ignore"):
        size = np.where((a == b) | (np.isnan(a) & np.isnan(b)), 0.0, np.abs(a - b))
    if not np.any(size != 0.0):
        return "differs in signs of zeros or kinds of NaN alone"
    place = np.unravel_index(np.argmax(np.where(np.isnan(size), np.inf, size)), size.shape)
    entry = ", ".join(str(k) for k in place)
    return (f"differs in {np.count_nonzero(size)} of {size.size} numbers, by at most {size[place]:.3g} "
            f"(entry {entry}: {a[place]:.17g} against {b[place]:.17g})")


def how_states_differ(path_a, path_b, residuals):
    """Describes the first array that differs; None if there is none."""
    a, b = datasets(path_a), datasets(path_b)
    differing = []
    for name in in_order(a.keys() | b.keys()):
        x, y = a.get(name), b.get(name)
        if (x is None or y is None) and may_be_absent(name) and not np.any(y if x is None else x):
            continue
        if name == "equilibrium/residuals" and x is not None and y is not None and residuals.same(x, y):
            continue
        words = how_numbers_differ(x, y)
        if words is not None:
            differing.append(f"{name} {words}")
    if not differing:
        return None
    return f"{differing[0]} (datasets that differ: {len(differing)})"


def read_table(path):
    """Returns the rows of a csv file, each a dictionary by column."""
    with open(path, newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))


def how_paths_differ(path_a, path_b, residuals):
    """Describes the first row of path.csv that differs in a column other than `seconds`; None if there is none."""
    a, b = read_table(path_a), read_table(path_b)
    for k, (row_a, row_b) in enumerate(zip(a, b)):
        if list(row_a) != list(row_b):
            return f"has columns {','.join(row_a)} against {','.join(row_b)}"
        for name, value in row_a.items():
            if name.startswith("residual_") and residuals.same(value, row_b[name]):
                continue
            if name != "seconds" and value != row_b[name]:
                return f"row {k}, {name}: {value} against {row_b[name]}"
    if len(a) != len(b):
        return f"has {len(a)} rows against {len(b)}"
    return None


def states_of(directory):
    """Returns the names of the state files of a run."""
    if not os.path.exists(os.path.join(directory, "path.csv")):
        raise BadInput(f"{directory}: holds no path.csv, expected a directory that floc run made")
    return {name for name in os.listdir(directory) if name.startswith("state-") and name.endswith(".h5")}


def compare_bits(directory_a, directory_b, residuals):
    """Prints the differences of two runs. Returns whether there are any."""
    states_a, states_b = states_of(directory_a), states_of(directory_b)
    if not states_a and not states_b:
        raise BadInput(f"{directory_a}, {directory_b}: hold no states")
    differing = 0
    for name in sorted(states_a | states_b) + ["path.csv"]:
        path_a, path_b = os.path.join(directory_a, name), os.path.join(directory_b, name)
        if name == "path.csv":
            words = how_paths_differ(path_a, path_b, residuals)
        elif name not in states_a or name not in states_b:
            words = f"is missing in {directory_b if name in states_a else directory_a}"
        else:
            words = how_states_differ(path_a, path_b, residuals)
        if words is not None:
            differing += 1
            print(f"{name}: {words}")
    n_states = len(states_a | states_b)
    verdict = f"{differing} differ" if differing else "the same, bit for bit"
    if residuals.n_moved:
        verdict += f", but for {residuals.n_moved} differences of residuals by at most {residuals.tolerance:g}"
    print(f"{n_states} states and path.csv: {verdict}")
    return differing > 0


def logarithm(text):
    """Returns ln of a modulus, or None if it is missing or zero."""
    return math.log(float(text)) if text and float(text) > 0.0 else None


def observables(directory):
    """Returns {(name, step): value} for one sample."""
    states_of(directory)
    values = {}
    step_of = {}
    for row in read_table(os.path.join(directory, "path.csv")):
        step = int(row["step"])
        step_of[row["state"]] = step
        values["phi", step] = float(row["phi"])
        values["z", step] = float(row["z"])
    moduli = os.path.join(directory, "moduli.csv")
    if os.path.exists(moduli):
        for row in read_table(moduli):
            step = step_of.get(os.path.basename(row["file"]))
            if step is not None:
                values["ln B", step] = logarithm(row["B"])
                values["ln G", step] = logarithm(row["G"])
    return {key: value for key, value in values.items() if value is not None}


def by_name(directories):
    """Returns the observables of each sample, by the name of its directory."""
    samples = {os.path.basename(os.path.normpath(path)): observables(path) for path in directories}
    if len(samples) < len(directories):
        raise BadInput("two directories of one list have the same name: samples are paired by it")
    return samples


def paired_difference(a, b):
    """Returns the mean of b - a, its standard error and Student's t. If the error is 0, t is infinite, or 0 if there
    is no difference."""
    difference = np.asarray(b) - np.asarray(a)
    mean = difference.mean()
    error = difference.std(ddof=1) / math.sqrt(len(difference))
    if error > 0.0:
        return mean, error, mean / error
    return mean, error, math.copysign(math.inf, mean) if mean != 0.0 else 0.0


def compare_means(directories_a, directories_b, steps):
    """Prints a row for each observable and step that at least two pairs of samples have."""
    a, b = by_name(directories_a), by_name(directories_b)
    if a.keys() != b.keys():
        raise BadInput("samples without a partner: " + ", ".join(sorted(a.keys() ^ b.keys())))
    if len(a) < 2:
        raise BadInput("one pair of samples has no standard error: expected two or more")
    print(f"{'':6}{'step':>5}{'n':>4}{'mean A':>13}{'mean B':>13}{'B - A':>13}{'error':>13}{'t':>8}")
    largest = (0.0, "no observable")
    n_rows = 0
    for name in ("phi", "z", "ln B", "ln G"):
        for step in steps:
            key = (name, step)
            pairs = [(a[seed][key], b[seed][key]) for seed in a if key in a[seed] and key in b[seed]]
            if len(pairs) < 2:
                continue
            of_a, of_b = np.transpose(pairs)
            mean, error, t = paired_difference(of_a, of_b)
            print(f"{name:6}{step:5}{len(pairs):4}{of_a.mean():13.6g}{of_b.mean():13.6g}"
                  f"{mean:13.3g}{error:13.3g}{t:8.2f}")
            largest = max(largest, (abs(t), f"{name} at step {step}"))
            n_rows += 1
    if n_rows == 0:
        raise BadInput("no step asked for is there in two pairs of samples")
    print(f"largest |t| = {largest[0]:.2f} ({largest[1]}), of {n_rows}")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="*", metavar="RUN", help="two run directories, compared bit for bit")
    parser.add_argument("--residuals", type=float, default=0.0, metavar="T",
                        help="residuals that differ by no more are the same (in F1; default: 0)")
    parser.add_argument("--means", nargs="+", metavar="DIR", help="samples A")
    parser.add_argument("--against", nargs="+", metavar="DIR", help="samples B, of the same seeds")
    parser.add_argument("--steps", nargs="+", type=int, default=[6, 8, 12, 16, 25], metavar="K",
                        help="steps for --means (default: those of 6 8 12 16 25 that exist)")
    arguments = parser.parse_args()
    if bool(arguments.means) != bool(arguments.against):
        parser.error("--means and --against go together")
    if len(arguments.runs) != (0 if arguments.means else 2):
        parser.error("expected two run directories, or --means DIR... --against DIR...")
    return arguments


def main():
    arguments = parse_arguments()
    try:
        if arguments.means:
            compare_means(arguments.means, arguments.against, arguments.steps)
            return 0
        return 1 if compare_bits(*arguments.runs, Residuals(arguments.residuals)) else 0
    except (BadInput, OSError) as e:
        print(f"compare_runs.py: {e}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
