#!/usr/bin/env python3
"""Prints, from the tables KIND.csv of this folder, a row for each kind of scene: the settings that change results most
and least, as a table of docs/accuracy.md.

The error of a setting in an observable is the larger of the bound of the errors of single states, and of what the mean differs from
that of the strict settings beyond the half width of its 95 % interval. The change by a setting is how much that error differs from the one
of the scene as it is, the largest among the values of the setting and among two observables: the solid fraction, and the bulk modulus
(z_pairs of rigid grains; of lattices Young's modulus and the tail in grains). The cost is the least and the largest processor
time over that of the scene as it is. Numbers of grains and of steps, whose effects are in means alone, are left out.
"""

import argparse
import csv
import glob
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
NO_SETTINGS = {"strict", "scene", "together", "samples", "moduli", "count", "steps_per_decade"}
MAIN = ("phi", "B", "z_pairs", "E_lattice", "beta_grain")


def number(text):
    return float(text) if text else math.nan


def error_of(row):
    """Returns the relative error of an observable with a setting; 0 where none is known."""
    errors = [number(row["error_before_high"]), number(row["error_after_high"]),
              abs(number(row["mean_difference"])) - number(row["mean_error95"])]
    return max([error for error in errors if error > 0.0], default=0.0)


def observables_of(rows):
    known = {row["observable"] for row in rows}
    chosen = [name for name in MAIN if name in known]
    return [name for name in chosen if name != "z_pairs" or "B" not in known]


def settings_of(rows):
    """Returns (change, least cost, largest cost, name) of every setting, the largest change first."""
    scene = {row["observable"]: row for row in rows if row["knob"] == "scene"}
    settings = {}
    for row in rows:
        if row["knob"] in NO_SETTINGS or row["observable"] not in observables_of(rows):
            continue
        plain = scene[row["observable"]]
        cost = number(row["cost_ratio"]) / number(plain["cost_ratio"])
        change = abs(error_of(row) - error_of(plain))
        largest, low, high = settings.get(row["knob"], (0.0, math.inf, 0.0))
        settings[row["knob"]] = (max(largest, change), min(low, cost), max(high, cost))
    return sorted(((*values, name) for name, values in settings.items()), reverse=True)


def words(setting):
    change, low, high, name = setting
    return f"{name} ({change:.0e}; {low:.2g} to {high:.2g})"


def row_of(file):
    """Returns the row of one table: kind, number of samples, settings that matter most and least."""
    with open(file, encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    settings = settings_of(rows)
    n = next(row["n_samples"] for row in rows if row["knob"] == "strict")
    some = min(3, len(settings) // 2)
    return rows[0]["kind"], n, "; ".join(map(words, settings[:some])), "; ".join(map(words, settings[::-1][:some]))


def rows_of(folder):
    return [row_of(file) for file in sorted(glob.glob(os.path.join(folder, "*.csv")))
            if os.path.basename(file) != "tradeoff.csv"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", default=HERE, help="folder of the tables [that of this script]")
    print("| kind | samples | settings that matter most | settings that matter least |")
    print("|------|---------|---------------------------|----------------------------|")
    for row in rows_of(parser.parse_args().folder):
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
