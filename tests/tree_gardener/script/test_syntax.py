"""The names in a script."""

from __future__ import annotations

from tree_gardener.script import names_read, names_written, parse


def test_names_are_distinguished() -> None:
    program = parse("a := b + 1; c += d; e = (f := 2)")
    assert [name.name for name in names_written(program)] == ["a", "c", "e", "f"]
    assert [name.name for name in names_read(program)] == ["b", "c", "d", "e"]
    assert names_written(program)[1].span == (12, 13)
