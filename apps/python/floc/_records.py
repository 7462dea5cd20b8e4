"""Rows of tables as objects."""
import collections.abc
import difflib

from . import _core
from ._column_names import names as names_of

_REFERENCE = _core.column_reference()


def columns(table):
    """Returns the columns of a table of the program: name, unit and meaning, as ``floc help columns`` prints them.

    Parameters
    ----------
    table : str
        ``"moduli"``, ``"network"``, ``"structure"``, ``"compare"``, ``"fit consolidation"``,
        ``"moduli --increments"``, ``"path.csv"``, ...

    Returns
    -------
    list of (str, str, str)
        One (name, unit, meaning) per column. A letter ``?`` in a name stands for an index.
    """
    from ._errors import InputError
    if not isinstance(table, str):
        raise InputError(f"table = {table!r}: expected the name of a table, such as \"moduli\"")
    if table in _REFERENCE:
        return list(_REFERENCE[table])
    nearest = difflib.get_close_matches(table, _REFERENCE, 1, 0.0)[0]
    raise InputError(f'no table is named "{table}"; the nearest is "{nearest}"')


def with_columns(table):
    """Returns a decorator that adds the columns of a table to a class and to its docstring."""
    def decorated(cls):
        lines = [f"    {name}{f' ({unit})' if unit else ''}: {meaning}" for name, unit, meaning in columns(table)]
        cls.__doc__ += "\n\n    Columns: name (unit): meaning.\n\n" + "\n".join(lines) + "\n"
        cls._documented = frozenset(column for name, _, _ in columns(table) for column in names_of(name))
        return cls
    return decorated


class ReadOnly:
    """Base of results, whose attributes cannot be assigned: an attribute would then differ from the item of its name."""

    def __setattr__(self, name, value):
        raise AttributeError(f"{type(self).__name__} cannot be changed: to_dict() returns a copy")

    def __delattr__(self, name):
        self.__setattr__(name, None)


class Record(ReadOnly, collections.abc.Mapping):
    """A row of a table: each column is an attribute and a key; None where a value is not defined.

    Columns of the table that this row lacks, such as entries of a stiffness matrix in 3D for a row in 2D, are no keys, and
    their attributes are None.

    ``tables`` holds the additional tables that the caller requested. Each is a dict with one array per column, from
    which ``pandas.DataFrame(table)`` makes a data frame.
    """

    _documented = frozenset()

    def __init__(self, names, values, tables=None):
        self.__dict__.update(_values=dict(zip(names, values)), tables=tables if tables is not None else {})

    def __getattr__(self, name):
        values = self.__dict__.get("_values", {})
        if name in values:
            return values[name]
        if name in self._documented:
            return None
        nearest = difflib.get_close_matches(name, values, 1)
        raise AttributeError(f"{type(self).__name__} has no column {name!r}"
                             + (f"; the nearest is {nearest[0]!r}" if nearest else ""))

    def __getitem__(self, name):
        return self._values[name]

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __dir__(self):
        return [*super().__dir__(), *(name for name in self._values if name.isidentifier())]

    def to_dict(self):
        """Returns a dict of all columns and their values, in the order in which the command prints them."""
        return dict(self._values)

    def __repr__(self):
        width = max((len(name) for name in self._values), default=0)
        lines = [f"  {name:{width}}  {value!r}" for name, value in self._values.items()]
        return "\n".join([f"{type(self).__name__}:", *lines])


class Records(list):
    """A list of rows, one or more per state. ``tables`` holds the additional tables, each for all states."""

    def __init__(self, rows, tables=None):
        super().__init__(rows)
        self.tables = tables if tables is not None else {}

    def to_dict(self):
        """Returns a dict with a list of values per column, for ``pandas.DataFrame(rows.to_dict())``."""
        return {name: [row[name] for row in self] for name in (self[0] if self else ())}


def records(cls, table, further, single):
    """Converts a table of the compiled module to a row, or to a list of rows if there are several states."""
    names, rows = table
    made = [cls(names, row, further) for row in rows]
    return made[0] if single and len(made) == 1 else Records(made, further)
