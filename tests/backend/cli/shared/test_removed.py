"""A command or an option that was removed is refused in one sentence that says what to use instead."""

from __future__ import annotations

import sys

import pytest

from backend.cli import main
from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
from backend.cli.shared.removed import REMOVED, refuse_removed
from tests.cli.typed import studio


@pytest.mark.parametrize(
    ("typed", "removed"),
    [
        (["debug", "project", "--seed", "3"], "debug"),
        (["debug", "--help"], "debug"),
        (["run", "project", "--serve-viewer"], "run --serve-viewer"),
        (["run", "--headless", "project"], "run --headless"),
    ],
)
def test_it_is_refused_as_a_wrong_use(
    typed: list[str], removed: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["bt-studio", *typed])
    with pytest.raises(SystemExit) as ended:
        main.main()
    assert ended.value.code == BAD_ARGUMENTS
    [line] = capsys.readouterr().err.splitlines()
    assert line == f"bt-studio {removed} was removed: {REMOVED[tuple(removed.split())]}"


def test_what_is_there_is_not_refused_and_what_was_removed_is_not_there() -> None:
    for name in main.VERBS:
        refuse_removed(name)
    refuse_removed("run", "--record")
    with pytest.raises(CliError):
        refuse_removed("run", "--serve-viewer")
    assert not {words[0] for words in REMOVED if len(words) == 1} & set(main.VERBS)


def test_a_word_behind_the_options_is_no_option() -> None:
    done = studio("run", "--", "--headless")
    assert done.returncode == BAD_ARGUMENTS
    assert done.stderr == "--headless:1:1: there is no such file, folder or project\n"
