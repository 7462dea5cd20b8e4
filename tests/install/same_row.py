"""Compares the row of moduli of one state, printed by the program, by a C++ program of ten lines and by the Python
package: all numbers are equal to the last bit, except processor times.

    same_row.py FLOC ROW STATE        with floc on PYTHONPATH where the package is installed
"""
import csv
import subprocess
import sys

TIMES = {"seconds", "seconds_row"}


def row_of(*command):
    rows = list(csv.DictReader(subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()))
    assert len(rows) == 1, command
    return {name: text for name, text in rows[0].items() if name not in TIMES}


def main():
    floc, row, state = sys.argv[1:]
    by_program = row_of(floc, "moduli", state, "--format", "csv")
    assert len(by_program) > 60, sorted(by_program)
    by_library = row_of(row, state)
    assert by_library == by_program, {n: (by_library.get(n), t) for n, t in by_program.items() if by_library.get(n) != t}
    try:
        import floc as package
    except ImportError:
        print("without the Python package")
        return
    moduli = package.moduli(package.read(state))
    for name, text in by_program.items():
        value = getattr(moduli, name)
        same = text == ("" if value is None else str(value).lower() if isinstance(value, bool) else str(value))
        assert same or float(text) == value, (name, text, value)


if __name__ == "__main__":
    main()
