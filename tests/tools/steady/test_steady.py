"""Each test file is repeated, what ever failed is listed, and nothing is left of a run that ends early."""

from __future__ import annotations

import json
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from tests.deadline import DEADLINE_S, wait_until
from tests.tools.steady import __main__ as steady
from tests.tools.steady import runs as steady_runs
from tests.tools.steady.files import digest
from tests.tools.steady.results import Repeat, report

PASSES = "def test_it():\n    pass\n"
# It fails the second time.
SECOND_FAILS = """
from pathlib import Path

def test_it():
    seen = Path(__file__).parents[1] / "var" / "seen"
    if seen.exists():
        seen.unlink()
        raise ValueError("seen before")
    seen.touch()

def test_other():
    pass
"""
WAITS = """
import time
from pathlib import Path

def test_it():
    (Path(__file__).parents[1] / "var" / "begun").touch()
    time.sleep(600)
"""


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A tree with one test file; pytest loads no plugins there, to be quick."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    (tmp_path / "var").mkdir()
    write(tmp_path, PASSES)
    return tmp_path


def write(tree: Path, source: str, name: str = "tests/test_tiny.py") -> None:
    path = tree / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(source)


def lines(tree: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (tree / "var" / "steady.jsonl").read_text().splitlines()]


def test_what_failed_once_is_listed_with_its_counts(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tree, SECOND_FAILS)
    assert steady.main(["--repeats", "2"], tree) == 1
    said = capsys.readouterr().out
    assert "FAILED tests/test_tiny.py::test_it: 0 of 1 idle, 1 of 1 loaded" in said
    assert "seen before" in said
    first, second = lines(tree)
    assert first | {"seconds": 0} == {
        "file": "tests/test_tiny.py",
        "loaded": False,
        "passed": 2,
        "failed": {},
        "seconds": 0,
        "tree": digest(tree),
    }
    assert (second["loaded"], second["passed"], list(second["failed"])) == (True, 1, ["test_it"])
    assert steady.main(["--report"], tree) == 1
    assert "1 of 1 loaded" in capsys.readouterr().out


def test_a_slice_continues_until_the_tree_changes(tree: Path) -> None:
    assert steady.main(["--repeats", "1"], tree) == 0
    assert steady.main(["--repeats", "1"], tree) == 0
    assert len(lines(tree)) == 1
    write(tree, PASSES + "# another tree\n")
    assert steady.main(["--repeats", "1"], tree) == 0
    assert len({line["tree"] for line in lines(tree)}) == 2


def test_a_file_that_cannot_be_collected_has_failed(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tree, "import nothing_of_this_name\n")
    assert steady.main(["--repeats", "1"], tree) == 1
    assert "FAILED tests/test_tiny.py::" in capsys.readouterr().out


def test_a_run_that_dies_has_failed_as_a_whole(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tree, "import os\n\ndef test_it():\n    os._exit(9)\n")
    assert steady.main(["--repeats", "1"], tree) == 1
    assert "FAILED tests/test_tiny.py::the run itself: 1 of 1 idle" in capsys.readouterr().out


def test_rounds_with_load_stand_between_the_others() -> None:
    assert [is_loaded for _, is_loaded in steady.to_do(["a"], [], 6, 3)] == [False, True] * 3
    assert [is_loaded for _, is_loaded in steady.to_do(["a"], [], 3, 0)] == [False] * 3
    assert [is_loaded for _, is_loaded in steady.to_do(["a"], [], 3, 3)] == [True] * 3


def test_each_file_has_a_repeat_before_one_has_two() -> None:
    done = [Repeat("a", is_loaded=False, passed=1, failed={}, seconds=1.0, tree="t")]
    assert list(steady.to_do(["a", "b"], done, 2, 1)) == [("b", False), ("a", True), ("b", True)]


def test_failures_of_another_tree_are_listed_but_not_counted() -> None:
    repeat = Repeat("a", is_loaded=True, passed=0, failed={"x": "why"}, seconds=1.0, tree="old")
    text, has_failures = report([repeat], "new", ["a"])
    assert "FAILED a::x: 0 of 0 idle, 1 of 1 loaded (another tree: old)" in text
    assert not has_failures


def test_a_change_of_a_source_changes_the_digest_and_a_result_does_not(tree: Path) -> None:
    before = digest(tree)
    write(tree, "x", "var/steady.jsonl")
    write(tree, "x", "tests/__pycache__/y.pyc")
    assert digest(tree) == before
    write(tree, "x = 1\n", "product/module.py")
    assert digest(tree) != before


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (["tests/test_gone.py"], "tests/test_gone.py does not exist."),
        (["empty"], "empty holds no test file."),
        (["tests/helper.py"], "tests/helper.py is no test file."),
        (["/proc"], "/proc is outside of"),
    ],
)
def test_a_wrong_name_is_one_sentence(
    tree: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], why: str
) -> None:
    (tree / "empty").mkdir()
    write(tree, "x = 1\n", "tests/helper.py")
    assert steady.main(arguments, tree) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"steady: {why}")
    assert said.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (["--repeats", "0"], "--repeats is 1 at least"),
        (["--repeats", "4", "--loaded", "5"], "from 0 to the 4 repeats"),
        (["--slice", "0"], "more than 0 seconds"),
    ],
)
def test_a_wrong_number_is_refused(
    tree: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], why: str
) -> None:
    with pytest.raises(SystemExit) as ended:
        steady.main(arguments, tree)
    assert ended.value.code == 2
    assert why in capsys.readouterr().err


GOOD = '{"file":"a","loaded":false,"passed":1,"failed":{},"seconds":1,"tree":"t"}\n'


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (GOOD + "{}\n" + GOOD, "line 2 of"),
        (GOOD + "nonsense\n", "is damaged: delete it."),
        (GOOD + GOOD[:30], "line 2 of"),
        (GOOD[:30], "ends in the middle: delete it."),
        (GOOD[:-1], "ends in the middle: delete it."),
    ],
)
def test_a_damaged_result_is_named_and_nothing_runs(
    tree: Path, capsys: pytest.CaptureFixture[str], content: str, why: str
) -> None:
    write(tree, content, "var/steady.jsonl")
    assert steady.main([], tree) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
    assert (tree / "var" / "steady.jsonl").read_text() == content


def program(tree: Path, *arguments: str, largest_file: int | None = None) -> subprocess.Popen[str]:
    call = f"main({list(arguments)!r}, Path({str(tree)!r}))"

    def limit() -> None:
        if largest_file is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

    return subprocess.Popen(
        [
            sys.executable,
            "-c",
            f"from pathlib import Path; from tests.tools.steady.__main__ import main; exit({call})",
        ],
        cwd=Path(__file__).parents[3],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=limit,  # noqa: PLW1509 - it calls the kernel alone
    )


@pytest.mark.parametrize(
    ("results", "left", "why"),
    [
        (GOOD * 1000, 20, "steady.jsonl cannot be written: File too large."),
        (GOOD, 20, "junit.xml is half a report: is the disk full?"),
    ],
)
def test_a_full_disk_is_one_sentence_and_leaves_no_half_line(
    tree: Path, results: str, left: int, why: str
) -> None:
    write(tree, results, "var/steady.jsonl")
    with program(tree, "--repeats", "1", largest_file=len(results) + left) as process:
        _, said = process.communicate(timeout=DEADLINE_S)
    assert process.returncode == 2, said
    assert why in said
    assert said.count("\n") == 1
    assert (tree / "var" / "steady.jsonl").read_text() == results
    assert not (tree / "var" / "steady").exists()


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_nothing_runs_on_when_the_program_is_ended(tree: Path, how: signal.Signals) -> None:
    write(tree, WAITS)
    with program(tree, "--repeats", "1", "--loaded", "1") as process:
        wait_until((tree / "var" / "begun").exists, "the test has begun")
        below = psutil.Process(process.pid).children(recursive=True)
        assert len(below) == steady_runs.BUSY + 1
        process.send_signal(how)
        said = process.communicate(timeout=DEADLINE_S)[1]
        _, alive = psutil.wait_procs(below, timeout=DEADLINE_S)
    assert alive == []
    assert lines(tree) == []
    if how is signal.SIGINT:
        assert process.returncode == 130
        assert said == "steady: it was interrupted; the same command continues.\n"
        assert not (tree / "var" / "steady").exists()


def test_a_second_run_beside_is_refused(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tree, WAITS)
    with program(tree, "--repeats", "1") as process:
        wait_until((tree / "var" / "begun").exists, "the test has begun")
        assert steady.main([], tree) == 2
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=DEADLINE_S)
    assert "another run of this program writes to" in capsys.readouterr().err
