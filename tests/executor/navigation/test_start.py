"""A world without Nav2's interfaces has no navigation."""

from __future__ import annotations

import importlib.util
from typing import TYPE_CHECKING, Any

from executor.navigation import start

if TYPE_CHECKING:
    import pytest


def test_without_the_interfaces_there_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing: Any = None
    monkeypatch.setattr(
        start, "find_spec", lambda name: None if name == "nav2_msgs" else importlib.util.find_spec(name)
    )
    assert start.make_navigation(nothing, nothing) is None
