# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of sslcd. Their messages are those of the C++ library: the problem, its place and
a remedy."""


class Error(Exception):
    """Base of all errors that sslcd raises on purpose."""


class UsageError(Error, ValueError):
    """The call itself is wrong, e.g. an array of another shape."""


class BadInputError(Error, ValueError):
    """An input file or value is wrong."""


class BadConfigError(Error, ValueError):
    """An option's key or value is wrong."""


class NoSolutionError(Error, RuntimeError):
    """The input is valid, but there is no solution."""


class OutputError(Error, OSError):
    """A result could not be written."""
