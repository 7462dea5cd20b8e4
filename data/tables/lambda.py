#!/usr/bin/env python3
"""Prints lambda of every committed ensemble by the default fit, beside the published values, as a table in Markdown.

    data/tables/lambda.py PROGRAM

Each ensemble is fitted as `floc fit consolidation` fits it; the row is that of the mean of its samples.
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

TABLES = pathlib.Path(__file__).resolve().parent
CAMPAIGN = TABLES.parent / "campaigns/powder2d/runs.csv"
CURVES = TABLES / "loads/curves.csv"
# Published for 1400 disks [GRC2008].
SMALL, NONE = "0.194", "0.349"


def written(directory, rows, keys):
    """Writes rows of a table as the path tables of an ensemble. @return the directory"""
    for seed in sorted({row["seed"] for row in rows}, key=int):
        folder = directory / f"seed-{seed}"
        folder.mkdir(parents=True)
        with open(folder / "path.csv", "w", encoding="utf-8", newline="") as file:
            table = csv.writer(file)
            table.writerow(keys)
            table.writerows([row[key] for key in keys] for row in rows if row["seed"] == seed)
    return directory


def ensembles(scratch):
    """Yields name, directory and published lambda of each ensemble."""
    yield "`data/tables/consolidation`, 5600 disks", TABLES / "consolidation", SMALL
    yield "`data/tables/demo`, 400 disks", TABLES / "demo", SMALL
    curves = list(csv.DictReader(open(CURVES, encoding="utf-8")))
    for control in ("isotropic", "oedometric"):
        rows = [row for row in curves if row["control"] == control]
        yield f"`data/tables/loads`, {control}", written(scratch / control, rows, ["P_star", "phi"]), "-"
    runs = list(csv.DictReader(open(CAMPAIGN, encoding="utf-8")))
    for case, published in (("type-1-none", "-"), ("type-1-small", "-"), ("type-2-none", NONE), ("type-2-small", SMALL)):
        rows = [row for row in runs if row["case"] == case]
        yield (f"`data/campaigns/powder2d`, {case}", written(scratch / case, rows, ["branch", "P_star", "phi"]),
               published)


def mean_of(program, directory, *options):
    """Returns the fit of the mean of an ensemble, and its number of samples."""
    printed = subprocess.run([program, "fit", "consolidation", str(directory), "--format", "json", *options], check=False,
                             capture_output=True, text=True).stdout
    fits = json.loads(printed)
    return fits[-1], len(fits) - 1


def shown(fit):
    """Returns lambda of a fit with its interval; a dash where the fit has none."""
    parameter = fit["parameters"].get("lambda", {})
    value, low, high = (parameter.get(key) for key in ("value", "low95", "high95"))
    return "-" if value is None else f"{value:.3f} ({low:.3f} to {high:.3f})"


def row_of(program, name, directory, published):
    mean, n = mean_of(program, directory)
    full, _ = mean_of(program, directory, "--law", "full")
    window = " to ".join(f"{P:.3g}" for P in mean["window"])
    return [name, str(n), mean["law"], shown(mean), window, shown(full), published]


def table(program):
    with tempfile.TemporaryDirectory() as scratch:
        return [row_of(program, *one) for one in ensembles(pathlib.Path(scratch))]


def main():
    print("| ensemble | samples | law | lambda | window | lambda with --law full | published |")
    print("|---|---|---|---|---|---|---|")
    for row in table(sys.argv[1]):
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
