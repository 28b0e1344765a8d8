"""Ticks trees that are deeper than Python's recursion limit permits."""

import sys
import threading
from collections.abc import Callable
from typing import Any, Final, TypeVar

DEEP: Final = 150
"""Trees up to this depth are ticked directly, since Python's default recursion limit suffices for them."""

DEEP_ASKING: Final = 50
"""The same while nodes ask a debugger, which takes more calls for each level, and some of its own."""

CALLS_ARE_FREE: Final[bool] = sys.version_info >= (3, 11)
"""Whether calls between Python functions need no space on the C stack."""

_FRAMES_PER_LEVEL: Final = 9
_STACK_BYTES_PER_LEVEL: Final = 16 * 1024

T = TypeVar("T")


def call_deep(function: Callable[[], T], depth: int) -> T:
    """Calls a function that recurses once or more for each level of a tree.

    From Python 3.11 on, calls between Python functions take no room on the C stack, so that a higher
    limit is enough; before, the call is made on a thread with a large stack.
    """
    before = sys.getrecursionlimit()
    needed = before + depth * _FRAMES_PER_LEVEL
    sys.setrecursionlimit(needed)
    try:
        return function() if CALLS_ARE_FREE else _on_large_stack(function, depth)
    finally:
        sys.setrecursionlimit(before)


def _on_large_stack(function: Callable[[], T], depth: int) -> T:
    result: list[Any] = []
    error: list[BaseException] = []

    def run() -> None:
        try:
            result.append(function())
        except BaseException as raised:
            error.append(raised)

    size_before = threading.stack_size(16 * 1024 * 1024 + depth * _STACK_BYTES_PER_LEVEL)
    try:
        thread = threading.Thread(target=run, name="deep tree")
        thread.start()
    finally:
        threading.stack_size(size_before)
    thread.join()
    if error:
        raise error[0]
    return result[0]  # type: ignore[no-any-return]
