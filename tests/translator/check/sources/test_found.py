"""A finding has the place of its node."""

from __future__ import annotations

import ast

from translator.check.sources.found import Moment, found_at


def test_a_finding_counts_columns_from_one() -> None:
    (statement,) = ast.parse("\nx = 1").body
    found = found_at("BT0640", statement, Moment.LATER, name="x")
    assert (found.line, found.column, found.values) == (2, 1, {"name": "x"})
    assert found_at("BT0640", ast.Module([], []), Moment.LOAD).line == 1
