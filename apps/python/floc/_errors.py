"""What floc raises and warns of, in the words of the program."""


class Error(Exception):
    """Whatever floc raises is one of these."""


class InputError(Error, ValueError):
    """Bad input: the message names file, line, dataset or array, the value, and what was expected."""


class FileError(Error, OSError):
    """A file could not be written: the disk is full, or the directory is not writable."""


class NumericalError(Error, ArithmeticError):
    """There is no result: a step that does not converge, moduli that a packing does not have."""


class EquilibriumError(NumericalError):
    """A state that should be in equilibrium is not."""


class FlocWarning(UserWarning):
    """What the program prints as a warning."""
