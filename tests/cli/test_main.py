"""The frame of the command line: verbs, exit statuses, and errors without tracebacks."""

from __future__ import annotations

import importlib
import subprocess
import sys
from pathlib import Path

import pytest

from backend.cli import main
from backend.cli.shared.errors import CliError


@pytest.mark.parametrize("name", list(main.VERBS))
def test_every_verb_of_the_table_exists_and_explains_itself(name: str) -> None:
    verb = main.VERBS[name]
    function = getattr(importlib.import_module(f"backend.cli.{verb.module}"), verb.function)
    assert function.__doc__


def test_help_lists_the_verbs_and_loads_neither_ros_nor_django() -> None:
    program = (
        "import sys; sys.argv = ['bt-studio', '--help']\n"
        "from backend.cli.main import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "print([m for m in ('rclpy', 'django', 'pybullet') if m in sys.modules])"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "serve" in result.stdout
    assert result.stdout.rstrip().endswith("[]")


def test_an_unknown_verb_is_a_bad_argument() -> None:
    result = subprocess.run(
        [sys.executable, "-m", "backend.cli.main", "fly"], capture_output=True, text=True, check=False
    )
    assert result.returncode == 2
    assert "fly" in result.stderr


def test_a_problem_is_said_on_stderr_with_its_status(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse() -> None:
        raise CliError("tree.xml:3:5: BT0001 Unknown node", status=1)

    monkeypatch.setattr(main, "app", refuse)
    with pytest.raises(SystemExit) as ended:
        main.main()
    assert ended.value.code == 1
    assert capsys.readouterr().err == "tree.xml:3:5: BT0001 Unknown node\n"


def test_a_defect_of_ours_is_one_sentence_and_a_report(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def break_down() -> None:
        raise ZeroDivisionError("nobody expected this")

    monkeypatch.setattr(main, "app", break_down)
    with pytest.raises(SystemExit) as ended:
        main.main()
    assert ended.value.code == 1
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert "nobody expected this" in said
    report = said.split("details are in ")[1].split(";")[0]
    try:
        assert "ZeroDivisionError" in Path(report).read_text()
    finally:
        Path(report).unlink()
