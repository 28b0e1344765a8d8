"""Records the output of actions in lock-step, with the node that printed it."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from executor.application.console import Console

if TYPE_CHECKING:
    from collections.abc import Callable
    from io import TextIOBase
    from typing import Any

    from executor.application.locate import Locator
    from executor.child_messages import Log

__all__ = ["RecordedOutput", "recorded"]


class RecordedOutput(Console):
    """Writes to the replaced stream as before, and sends each line.

    Floods are cut by simulated time, so that equal runs have equal recordings.
    """

    def __init__(
        self, level: Any, send: Callable[[Log], None], locator: Locator, original: Any, now_s: Any
    ) -> None:
        super().__init__(level, send, locator, original, now_s, clock=now_s)

    def write(self, text: str) -> int:
        """Writes the text, and sends each complete line."""
        self._original.write(text)
        return super().write(text)

    def flush(self) -> None:
        """Flushes the replaced stream; a line is sent when it is complete."""
        self._original.flush()


@contextlib.contextmanager
def recorded(output: TextIOBase | None, errors: TextIOBase | None) -> Any:
    """Replaces standard output and error while users' code runs; with None nothing is replaced."""
    if output is None or errors is None:
        yield
        return
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        yield
