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
    gaps = [_gaps(side, spine, base) for side in (ours, theirs)]
    for place, anchor in enumerate(("", *spine)):
        if anchor:
            result.append(anchor)
        for gap in gaps:
            result.extend(gap.get(place, ()))
    return result + sorted(set(members) - set(result)), is_conflict


def _gaps(side: Sequence[str], spine: Sequence[str], base: Sequence[str]) -> dict[int, list[str]]:
    """Returns the nodes that only one side has, by how many nodes of both stand before them.

    Each follows the node that it follows on its side. One that was exchanged with nodes of both stays so,
    also where the other side has moved these.
    """
    gaps: dict[int, list[str]] = {}
    places = {each: place for place, each in enumerate(spine, start=1)}
    old = {each: place for place, each in enumerate(base)}
    least = place = 0
    for index, each in enumerate(side):
        if each in places:
            least = place = places[each]
            continue
        place = max(place, least)
        if each in old:
            over = [places[x] for x in side[:index] if x in places and old.get(x, -1) > old[each]]
            under = [places[x] for x in side[index:] if x in places and old.get(x, len(old)) < old[each]]
            place = min([max([place, *over]), *(below - 1 for below in under)])
        gaps.setdefault(place, []).append(each)
    return gaps
