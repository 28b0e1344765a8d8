"""The keeper's command line: what it refuses before it opens Docker's socket."""

from __future__ import annotations

import pytest

from backend.sessions.keeper import __main__ as keeper


@pytest.mark.parametrize("name", keeper.REMOVED)
def test_a_setting_of_an_earlier_release_says_what_to_use_instead(name, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["keeper"])
    monkeypatch.setenv(name, "20")
    assert keeper.main() == 1
    assert capsys.readouterr().err == f"keeper: {name}: {keeper.INSTEAD}\n"
