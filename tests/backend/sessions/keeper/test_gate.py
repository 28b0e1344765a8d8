"""The keeper's side of the gate."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.gate import Gate


def test_without_a_gate_a_door_is_refused_and_nothing_is_left():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        gate = Gate(folder / "control", folder / "sessions", patience_s=0.1)
        with pytest.raises(KeeperError), gate.door("s1", "t0ken"):
            pytest.fail("there is no gate")
        gate.remove("s1")
        gate.remove("s1")
        assert list((folder / "sessions").iterdir()) == []
