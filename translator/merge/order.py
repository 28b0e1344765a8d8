"""Merges two orders of siblings that come from a common one."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence


def merge_order(
    sides: tuple[Sequence[str], Sequence[str], Sequence[str]], members: Collection[str]
) -> tuple[list[str], bool]:
    """Returns the members in their merged order, and whether both sides changed the order differently.

    Where both sides insert at one place, ours comes first. A conflict keeps our order.

    Args:
        sides: The siblings in the common version, in ours and in theirs.
        members: Those of the result.
    """
    base, ours, theirs = ([each for each in side if each in members] for side in sides)
    both = set(ours) & set(theirs)
    ours_now, theirs_now = ([each for each in side if each in both] for side in (ours, theirs))
    before = [each for each in base if each in both]
    known = set(before)
    is_conflict = False
    if ours_now == theirs_now:
        spine = ours_now
    else:
        ours_kept = [each for each in ours_now if each in known] == before
        theirs_kept = [each for each in theirs_now if each in known] == before
        is_conflict = ours_kept == theirs_kept
        spine = theirs_now if ours_kept and not theirs_kept else ours_now
    result: list[str] = []
    gaps = [_gaps(side, both) for side in (ours, theirs)]
    for anchor in ("", *spine):
        if anchor:
            result.append(anchor)
        for gap in gaps:
            result.extend(gap.get(anchor, ()))
    return result + sorted(set(members) - set(result)), is_conflict


def _gaps(side: Sequence[str], both: Collection[str]) -> dict[str, list[str]]:
    """Returns the nodes that only one side has, by the node of both before them."""
    gaps: dict[str, list[str]] = {}
    anchor = ""
    for each in side:
        if each in both:
            anchor = each
        else:
            gaps.setdefault(anchor, []).append(each)
    return gaps
