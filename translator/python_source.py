"""Python source as a syntax tree, for programs with several threads.

CPython 3.11 counts in one place for all threads how deep it is in the making of a tree: two at once get
`SystemError: AST constructor recursion depth mismatch`, or hear that a tree is nested too deeply. So one
makes a tree at a time, and all do it here (`tests/translator/test_python_source.py` finds others).
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
        SyntaxError: it is no Python.
        ValueError, RecursionError, MemoryError: it cannot be read, such as for its depth.
    """
    with _lock, warnings.catch_warnings():  # an odd escape in the user's code is no matter of ours
        warnings.simplefilter("ignore")
        for _ in range(ATTEMPTS - 1):
            try:
                return ast.parse(source, filename=filename)
            except (SystemError, RecursionError):
                # The standard library makes trees, too: of lines that it marks in tracebacks, for the log.
                continue
        return ast.parse(source, filename=filename)
