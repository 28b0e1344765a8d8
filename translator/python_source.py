"""Python source as a syntax tree, for programs with several threads.

CPython 3.11 keeps the recursion depth of `ast.parse` in one counter for all threads: two calls at the same
time fail with `SystemError: AST constructor recursion depth mismatch`, or report a depth that no tree has. So
a lock admits one call at a time, and all calls are in this module (`tests/translator/test_python_source.py`
finds others).
"""

from __future__ import annotations

import ast
import warnings
from threading import Lock
from typing import Final

__all__ = ["parse"]

ATTEMPTS: Final = 3
_lock: Final = Lock()


def parse(source: str, filename: str) -> ast.Module:
    """Reads a module.

    Raises:
        SyntaxError: the source is not valid Python.
        ValueError, RecursionError, MemoryError: the source cannot be parsed, for example because of its
            depth.
    """
    with _lock, warnings.catch_warnings():  # an invalid escape in the user's code is reported elsewhere
        warnings.simplefilter("ignore")
        for _ in range(ATTEMPTS - 1):
            try:
                return ast.parse(source, filename=filename)
            except (SystemError, RecursionError):
                # The standard library may parse at the same time, to mark lines of tracebacks in the log.
                continue
        return ast.parse(source, filename=filename)
