"""The catalogue's files."""

from __future__ import annotations

import pytest

from backend.catalog import queries


def test_every_entry_has_its_files():
    for universe in queries.universes():
        text = queries.universe_text(universe["id"])
        assert (text is not None) or universe["id"] == queries.OUTSIDE or not universe["id"]
    for robot in queries.robots():
        assert queries.robot_config(robot["id"])
    assert queries.nodes()["nodes"]


@pytest.mark.parametrize("name", ["no", "../secrets", "a/b", ""])
def test_nothing_else_is_found(name):
    found = (queries.universe_text, queries.universe_preview, queries.robot_config, queries.robot_urdf)
    assert [find(name) for find in found] == [None] * 4
