"""Kinds of comparison between a printed value and the value that its description gives."""
import math

import numpy as np

TOLERANCE = 1e-8  # relative, of the value and of the scale that rounding has


def matches(actual, expected, allowed):
    if expected is None or (isinstance(expected, float) and math.isnan(expected)):
        return actual is None
    if actual is None:
        return False
    return abs(float(actual) - float(expected)) <= allowed


class Close:
    """Compares numbers within a tolerance. @param scale  size of terms that cancel in the expected value"""

    def __init__(self, expected, scale=0.0, tolerance=TOLERANCE):
        self.expected, self.scale, self.tolerance = expected, abs(scale), tolerance

    def fault(self, actual):
        many = np.ndim(self.expected) > 0
        expected, actual = (list(self.expected), list(actual)) if many else ([self.expected], [actual])
        if len(expected) != len(actual):
            return f"{len(actual)} rows, expected {len(expected)}"
        for k, (e, a) in enumerate(zip(expected, actual)):
            if not matches(a, e, self.tolerance * (abs(e or 0.0) + self.scale)):
                return f"{a!r}, expected {e!r}" + (f" in row {k}" if many else "")
        return None


class Same:
    """Requires exactly the expected value."""

    def __init__(self, expected):
        self.expected = expected

    def fault(self, actual):
        expected = self.expected.item() if isinstance(self.expected, np.generic) else self.expected
        if isinstance(expected, list):
            wrong = [k for k, (a, e) in enumerate(zip(actual, expected)) if a != e]
            if len(actual) == len(expected) and not wrong:
                return None
            return f"{len(actual)} rows, expected {len(expected)}" if not wrong else (
                f"{actual[wrong[0]]!r}, expected {expected[wrong[0]]!r} in row {wrong[0]} and {len(wrong) - 1} more")
        return None if actual == expected and isinstance(actual, bool) == isinstance(expected, bool) else (
            f"{actual!r}, expected {expected!r}")


class Holds:
    """Requires that the value satisfies a condition; `words` describes the condition."""

    def __init__(self, words, condition):
        self.words, self.condition = words, condition

    def fault(self, actual):
        return None if self.condition(actual) else f"{actual!r}, expected {self.words}"


class Exempt:
    """Marks a column that is not checked, with the reason."""

    def __init__(self, reason):
        self.reason = reason

    def fault(self, _):
        return None


class Tally:
    """Counts the comparisons and collects the faults."""

    def __init__(self):
        self.columns, self.exempt, self.states, self.faults, self.n_values = {}, {}, set(), [], 0

    def row(self, table, state, row, expected):
        """Compares a row, or a table by columns. Every printed column must be expected, and every expected column
        printed."""
        self.states.add(state)
        for name in row:
            check = expected.get(name)
            if check is None:
                self.faults.append(f"{table}: {name} has no recomputation")
                continue
            if isinstance(check, Exempt):
                self.exempt.setdefault((table, name), check.reason)
                continue
            self.columns.setdefault((table, name), set()).add(state)
            self.n_values += len(row[name]) if isinstance(row[name], list) else 1
            if fault := check.fault(row[name]):
                self.faults.append(f"{table}: {name} of {state}: {fault}")
