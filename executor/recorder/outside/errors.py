"""Errors of files from outside."""

from __future__ import annotations

from typing import Literal

from executor.recorder.reader import RecordingError

__all__ = ["Code", "OutsideError"]

Code = Literal["not_a_log", "damaged", "too_large", "no_tree", "times_run_back", "too_long"]


class OutsideError(RecordingError):
    """A file is no log that can be read.

    Args:
        code: what is wrong, for programs.
        name: the name of the file.
        place: the offset in bytes, or the row of a table.
        message: what is wrong, for people.
        hint: what they can do.
    """

    def __init__(self, code: Code, name: str, place: int, message: str, hint: str) -> None:
        super().__init__(name, place, message, hint)
        self.code = code
