"""Errors of the command line."""

from __future__ import annotations

import pytest

from backend.cli.shared.errors import CliError, exit_with


def test_the_program_ends_with_the_sentence_and_the_status(capsys):
    with pytest.raises(SystemExit) as ended:
        exit_with(CliError("it cannot be done"))
    assert ended.value.code
    assert "it cannot be done" in capsys.readouterr().err
