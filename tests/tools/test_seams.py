"""Tests replace no private state, but for what is on the list that only shrinks."""

from __future__ import annotations

import pytest

from tests.tools import seams


def test_no_test_replaces_private_state_that_is_not_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert seams.main([]) == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ("monkeypatch.setattr(module, '_workers', fake)", ["_workers"]),
        ("monkeypatch.setattr('package.module._workers', fake)", ["_workers"]),
        ("monkeypatch.setattr(module._teller, 'tell', fake)", ["_teller"]),
        ("patch.object(module, '_workers')", ["_workers"]),
        ("one._a, two.b = 1, 2", ["_a"]),
        ("one._table['x'] = 1", ["_table"]),
        ("one._count += 1", ["_count"]),
        ("self._a = self.b._c = 1", ["_c"]),
    ],
)
def test_private_state_of_another_object_is_found(source: str, found: list[str]) -> None:
    assert seams.find(source) == found


@pytest.mark.parametrize(
    "source",
    ["self._a = 1", "module.CLOCK = fake", "monkeypatch.setattr(module, 'CLOCK', fake)", "x = one._a"],
)
def test_public_names_and_the_tests_own_state_may_be_replaced(source: str) -> None:
    assert seams.find(source) == []
