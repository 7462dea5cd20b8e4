#!/usr/bin/env python3
"""Every column of the tables of states is recomputed from the arrays of the state file, by its description alone.

    columns_test.py --floc PROGRAM --source DIRECTORY [--only TABLE]

Samples of 20 to 60 grains of every kind are made in a temporary directory, and their arrays are read with h5py. The
expected numbers are computed without code of floc. A column that docs/columns.md describes, or that a table has, is a
fault if no recomputation exists for it.
"""
import argparse
import csv
import fnmatch
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import info
import moduli
import network
import path
import structure
from checks import Tally
from scenes import SCENES
from state import State

# Tables of docs/columns.md that are checked here, and the commands that print them.
TABLES = {**moduli.TABLES, **network.TABLES, **structure.TABLES, **info.TABLES, **path.TABLES}


class Program:
    def __init__(self, floc, directory):
        self.floc, self.directory = floc, directory

    def run(self, *arguments):
        done = subprocess.run([self.floc, *map(str, arguments)], capture_output=True, text=True, cwd=self.directory)
        if done.returncode != 0:
            sys.exit(f"FAULT: floc {' '.join(map(str, arguments))} ended with {done.returncode}: {done.stderr}")
        return done.stdout

    def rows(self, *arguments):
        """Returns the rows of a table with all digits."""
        return json.loads(self.run(*arguments, "--format", "json"))

    def table(self, file):
        """Returns a csv file as one list per column, with numbers, flags and texts, and None for empty cells."""
        with open(self.directory / file, newline="", encoding="utf-8") as stream:
            names, *rows = csv.reader(stream)
        return {name: [cell_value(row[k]) for row in rows] for k, name in enumerate(names)}


def cell_value(text):
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text or None


def described(source):
    """Returns the names of the columns that docs/columns.md lists for each table."""
    tables, name = {}, None
    for line in (source / "docs/columns.md").read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            name = line[3:]
            tables[name] = []
        elif line.startswith("| ") and not line.startswith("| column"):
            tables[name].append(line.split("|")[1].strip())
    return tables


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True, type=pathlib.Path)
    parser.add_argument("--only", help="one module: moduli, network, structure, info or path")
    arguments = parser.parse_args()
    tally = Tally()
    with tempfile.TemporaryDirectory(prefix="floc-columns-") as directory:
        program = Program(arguments.floc, pathlib.Path(directory))
        states = {}
        for name, scene in SCENES.items():
            (program.directory / f"{name}.toml").write_text(scene)
            program.run("run", f"{name}.toml", "-o", name)
            states[name] = [State(file) for file in sorted((program.directory / name).glob("state-*.h5"))]
        for module in (moduli, network, structure, info, path):
            if arguments.only in (None, module.__name__):
                start = time.process_time()
                module.check(program, states, tally)
                print(f"{module.__name__}: {time.process_time() - start:.1f} s")
    if arguments.only is None:
        complain_of_missing(described(arguments.source), tally)
    for fault in tally.faults:
        print("FAULT:", fault)
    tables = {table for table, _ in tally.columns}
    print(f"{len(tally.columns)} columns of {len(tables)} tables were recomputed on {len(tally.states)} states of "
          f"{len(SCENES)} kinds, {tally.n_values} values; not recomputed: "
          + "; ".join(f"{table}: {name} ({reason})" for (table, name), reason in sorted(tally.exempt.items())
                      if (table, name) not in tally.columns))
    return 1 if tally.faults else 0


def complain_of_missing(tables, tally):
    """Returns the described columns that were never compared."""
    seen = {*tally.columns, *tally.exempt}
    for table in TABLES:
        for pattern in tables[table]:
            if not any(of == table and fnmatch.fnmatchcase(name, pattern) for of, name in seen):
                tally.faults.append(f"{table}: {pattern} of docs/columns.md was compared on no state")


if __name__ == "__main__":
    sys.exit(main())
