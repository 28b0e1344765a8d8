"""All tests of the engine run generated code from the first tick on, not only after some ticks."""

from __future__ import annotations

import pytest

from tree_gardener.generated import generation


@pytest.fixture(autouse=True)
def _generates_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generation, "WARM_TICKS", 0)
    monkeypatch.setattr(generation, "BUDGET_S", float("inf"))
