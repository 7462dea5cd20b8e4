"""Names of the columns that a pattern in the reference of columns stands for. ``write-stub`` uses this file, too."""
import itertools


def indices(count, largest, symmetric=True):
    """Indices of a tensor of this order, as in names of columns: "1", or pairs such as "12" (smaller index first)."""
    numbers = [str(i) for i in range(1, largest + 1)]
    if count == 1:
        return numbers
    return ["".join(pair) for pair in itertools.product(numbers, numbers)
            if (pair[0] <= pair[1] if symmetric else pair[0] != pair[1])]


def names(pattern):
    """Names of the columns that a pattern in docs/columns.md stands for."""
    if pattern.startswith("*"):
        return [phase + pattern[1:] for phase in ("positive", "negative")]
    if "?" not in pattern:
        return [pattern]
    stem, count = pattern.rstrip("?"), pattern.count("?")
    if stem == "moment_":
        return ["moment_2", "moment_3", "moment_4"]
    return [stem + index for index in indices(count, 6 if stem == "C" else 3, stem != "nu_")]
