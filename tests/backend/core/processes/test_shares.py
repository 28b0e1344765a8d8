"""The owner who gets the next place."""

from __future__ import annotations

import pytest

from backend.core.processes.shares import Wish, order


def wishes(text):
    """Wishes such as `a1 b1 a2!`: owner and number; they are as old as they come first, `!` is exempt."""
    return [
        Wish(name.rstrip("!"), name[0], since, name.endswith("!")) for since, name in enumerate(text.split())
    ]


@pytest.mark.parametrize(
    ("waiting", "held", "most", "expected", "held_up"),
    [
        ("", {}, 2, "", ""),
        ("a1 b1 c1", {}, 2, "a1 b1 c1", ""),
        # One user who came first does not take all places.
        ("a1 a2 a3 b1", {}, 0, "a1 b1 a2 a3", ""),
        ("a1 a2 b1 c1 b2", {}, 2, "a1 b1 c1 a2 b2", ""),
        # Who has the fewest comes first, however late.
        ("a1 b1 c1", {"a": 1, "b": 2}, 3, "c1 a1 b1", ""),
        ("a1 a2 a3 b1 b2 b3", {"b": 1}, 0, "a1 a2 b1 a3 b2 b3", ""),
        # Beyond their limit users wait for themselves, and hold nobody else up.
        ("a1 a2 b1", {"a": 2}, 2, "b1", "a1 a2"),
        ("a1 a2 b1 a3", {"a": 1}, 2, "b1 a1", "a2 a3"),
        ("a1 b1 a2", {"a": 5, "b": 3}, 2, "", "a1 b1 a2"),
        ("a1", {"a": 100}, 0, "a1", ""),
        # A demonstration goes first, and has no limit.
        ("b1 a1! a2! b2", {"a": 9}, 2, "a1 a2 b1 b2", ""),
    ],
)
def test_the_next_place_goes_to_who_has_the_fewest(waiting, held, most, expected, held_up):
    found = order(reversed(wishes(waiting)), held, most)
    assert [wish.key for wish in found.next] == expected.split()
    assert [wish.key for wish in found.held_up] == held_up.split()


def test_nobody_is_lost_and_no_owner_exceeds_the_limit():
    many = wishes(" ".join(f"{owner}{number}" for number in range(40) for owner in "abcde"))
    found = order(many, {"a": 3, "e": 39}, 30)
    assert sorted([*found.next, *found.held_up]) == sorted(many)
    counts = {owner: sum(wish.owner == owner for wish in found.next) for owner in "abcde"}
    assert counts == {"a": 27, "b": 30, "c": 30, "d": 30, "e": 0}
