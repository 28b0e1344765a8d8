"""Suggestions for misspelt names, by Damerau-Levenshtein distance."""

from collections.abc import Iterable
from typing import Final

MAX_SLIPS: Final = 3
_LONGEST: Final = 100


def nearest(name: str, known: Iterable[str]) -> str:
    """Returns the nearest known name, or "" if none is within 3 edits and a third of the letters."""
    wanted = name.lower()[:_LONGEST]
    allowed = min(MAX_SLIPS, max(1, len(wanted) // 3))
    found = [
        (slips, each)
        for each in known
        if each != name and (slips := distance(wanted, each.lower()[:_LONGEST])) <= allowed
    ]
    return min(found)[1] if found else ""


def distance(first: str, second: str) -> int:
    """Counts the letters to delete, insert, replace or swap with their neighbour."""
    before: list[int] = []
    last = list(range(len(second) + 1))
    for i, letter in enumerate(first, start=1):
        row = [i]
        for j, other in enumerate(second, start=1):
            best = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == second[j - 2] and first[i - 2] == other:
                best = min(best, before[j - 2] + 1)
            row.append(best)
        before, last = last, row
    return last[-1]
