"""Processes that tests look for, some of which end at that moment."""

from __future__ import annotations

from typing import TYPE_CHECKING

import psutil

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["command_line", "with_word"]


def command_line(process: psutil.Process) -> list[str]:
    """Returns the words of a process's command line; none where it has ended, or waits to be reaped."""
    try:
        return process.cmdline()
    except psutil.Error:
        return []


def with_word(word: str, processes: Iterable[psutil.Process]) -> list[psutil.Process]:
    """Returns the processes that have a text in one of their words."""
    return [each for each in processes if any(word in part for part in command_line(each))]
