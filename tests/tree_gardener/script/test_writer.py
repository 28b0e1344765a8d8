"""Statements and parameters of generated scripts."""

from __future__ import annotations

import ast

from tree_gardener.script.writer import BOUND, FIXED, Value, Writer


def test_values_are_parameters_in_order_and_never_text() -> None:
    writer = Writer()
    names = [writer.constant(value) for value in ("__import__", 5, None)]
    assert names == ["c0", "c1", "c2"]
    assert list(writer.parameters.values()) == ["__import__", 5, None]


def test_variables_are_numbered_and_blocks_are_apart() -> None:
    writer = Writer()
    name = writer.set(writer.fixed("ONE"))
    with writer.block() as inner:
        writer.set(writer.fixed("ZERO"), name)
    assert [ast.unparse(ast.fix_missing_locations(part)) for part in writer.body] == ["t0 = ONE"]
    assert len(inner) == 1


def test_small_integers_become_floats_and_large_ones_stay() -> None:
    writer = Writer()
    small, large = (Value(writer.constant(number), "any", is_constant=True) for number in (5, 2**53))
    assert type(writer.parameters[writer.numeric(small).name]) is float
    assert writer.numeric(large) is large


def test_a_name_has_one_meaning() -> None:
    assert not set(FIXED) & set(BOUND)
