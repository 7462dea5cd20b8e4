"""Exceptions and warnings of floc, with the messages of the floc program."""


class Error(Exception):
    """Base class of all exceptions of floc."""


class InputError(Error, ValueError):
    """Bad input: the message names file, line, dataset or array, the value, and what was expected."""


class FileError(Error, OSError):
    """A file could not be written: the disk is full, or the directory is not writable."""


class NumericalError(Error, ArithmeticError):
    """A computation has no result: a step does not converge, or a packing does not have moduli."""


class EquilibriumError(NumericalError):
    """A state is not in equilibrium, but the computation requires an equilibrium."""


class FlocWarning(UserWarning):
    """A warning that the floc program prints."""
