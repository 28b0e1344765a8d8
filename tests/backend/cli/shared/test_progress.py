"""The progress line."""

from __future__ import annotations

import sys

import pytest

from backend.cli.shared.progress import show_progress


@pytest.mark.parametrize("is_terminal", [True, False])
def test_a_terminal_alone_gets_a_progress_line_that_replaces_the_last_one(capsys, monkeypatch, is_terminal):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal)
    show_progress("1 of 2")
    show_progress("")
    assert capsys.readouterr().err == ("\r\x1b[K1 of 2\r\x1b[K" if is_terminal else "")
