"""Two revisions compared: the arithmetic, the meter of processes, and comparisons in a tiny repository."""

from __future__ import annotations

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from tests.benchmarks.__main__ import BENCHMARKS, main
from tests.benchmarks.beside.pairs import Comparison, chance, compared, ratio, spread
from tests.benchmarks.beside.reuse import link_tree, reuse
from tests.benchmarks.beside.trees import Beside, CannotCompareError, this_tree
from tests.benchmarks.figures import Better, Figure, number
from tests.benchmarks.timing import pss_mb

ROOT = Path(__file__).resolve().parents[2]
DEADLINE_S = 120


def figure(name: str, value: float, better: Better = "lower") -> Figure:
    return Figure(name, value, "ms", better)


def test_a_ratio_is_ours_by_theirs_and_two_zeros_are_equal() -> None:
    assert (ratio(3, 2), ratio(0, 0), ratio(1, 0)) == (1.5, 1.0, math.inf)


def test_the_spread_is_least_quartiles_and_greatest() -> None:
    assert spread([5, 1, 2, 4, 3]) == (1, 2, 3, 4, 5)
    assert spread([1, 2]) == (1, 1.25, 1.5, 1.75, 2)
    assert spread([7.0]) == (7, 7, 7, 7, 7)
    assert spread([1, math.inf, 1])[2:] == (1, math.inf, math.inf)


def test_the_chance_is_that_of_the_sign_test() -> None:
    assert chance(7, 0) == chance(0, 7) == pytest.approx(2 / 128)
    assert chance(6, 1) == pytest.approx(16 / 128)
    assert chance(3, 4) == chance(0, 0) == 1


@pytest.mark.parametrize(
    ("ours", "better", "verdict"),
    [
        ([0.9] * 7, "lower", "better"),
        ([0.9] * 7, "higher", "worse"),
        ([1.1] * 7, "lower", "worse"),
        ([1.1] * 7, "higher", "better"),
        ([0.9] * 6, "lower", "no difference shown"),
        ([0.9] * 6 + [1.1], "lower", "no difference shown"),
        ([1.0] * 7, "lower", "no difference shown"),
    ],
)
def test_a_difference_is_shown_by_seven_pairs_of_seven(ours, better, verdict) -> None:
    comparison = Comparison(figure("x", 0, better), tuple(ours), (1.0,) * len(ours))
    assert comparison.verdict == verdict
    assert str(comparison).endswith(verdict)


def test_the_median_is_that_of_the_ratios_of_pairs_and_not_of_the_values() -> None:
    slow_machine_later = Comparison(figure("x", 0), (1.0, 10.0, 100.0), (1.0, 20.0, 100.0))
    assert slow_machine_later.ratios == [1.0, 0.5, 1.0]
    assert " 1.000 " in str(slow_machine_later)


def test_figures_are_compared_by_name_and_those_of_one_tree_are_named() -> None:
    pairs = [([figure("a", 1), figure("new", 1)], [figure("a", 2)]), ([figure("a", 3)], [figure("a", 4)])]
    comparisons, missing = compared(pairs)
    assert [(each.figure.name, each.ours, each.others) for each in comparisons] == [("a", (1, 3), (2, 4))]
    assert missing == ["new"]


def test_numbers_have_about_four_digits() -> None:
    assert [number(value) for value in (12345.6, 123.45, 1.234, 0.0123)] == [
        "12,346",
        "123.5",
        "1.23",
        "0.012",
    ]


def test_memory_is_the_sum_over_the_processes_below() -> None:
    program = (
        "import subprocess, sys; kept = bytearray(b'x' * 40_000_000)\n"
        "below = 'kept = bytearray(b\"y\" * 30_000_000); print(1, flush=True); input()'\n"
        "subprocess.run([sys.executable, '-c', below])"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        assert parent.stdout.readline() == "1\n"
        (child,) = psutil.Process(parent.pid).children()
        whole, part = pss_mb(parent.pid), pss_mb(child.pid)
        parent.communicate("\n")
    assert 30 < part < 70
    assert 70 < whole < 140
    assert pss_mb(parent.pid) == 0


def metered(tmp_path: Path, program: str) -> dict:
    result = tmp_path / "result.json"
    meter = [sys.executable, "-m", "tests.benchmarks.beside.meter", str(result), str(tmp_path)]
    subprocess.run([*meter, sys.executable, "-c", program], cwd=ROOT, check=True, timeout=DEADLINE_S)
    return json.loads(result.read_text())


def test_a_process_that_is_left_behind_is_counted_ended_and_named(tmp_path) -> None:
    burns = (
        "import time, pathlib\nwhile time.process_time() < 0.5: pass\n"
        "pathlib.Path('burnt').touch()\ntime.sleep(1000)"
    )
    program = (
        "import pathlib, subprocess, sys, time\n"
        f"subprocess.Popen([sys.executable, '-c', {burns!r}], start_new_session=True)\n"
        "while not pathlib.Path('burnt').exists(): time.sleep(0.05)"
    )
    found = metered(tmp_path, program)
    assert found["code"] == 0
    assert found["processor_s"] > 0.5
    assert [name.startswith("python") for name in found["left"]] == [True]


def test_the_exit_code_is_that_of_the_program(tmp_path) -> None:
    assert metered(tmp_path, "raise SystemExit(3)")["code"] == 3


def clone(root: Path, lock: str) -> Path:
    """A clone with the real set-up, of which everything was made before."""
    shutil.copytree(ROOT / "backend" / "setup", root / "backend" / "setup")
    for name in ("requirements.lock", "requirements-dev.lock", "requirements-build.lock", "pyproject.toml"):
        (root / name).write_text(lock)
    for name in (".venv/bin/uv", ".venv/bin/python", "frontend/dist/index.html"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text("made")
    (root / ".venv/bin/bt-studio").write_text(f"#!{root}/.venv/bin/python\n")
    return root


def stamped(root: Path) -> Path:
    program = (
        "import sys, runpy; made = runpy.run_path('backend/setup/__main__.py')\n"
        "names = ('python_step', 'own_package_step', 'front_end_step')\n"
        "for step in (made['packages_step']('test'), *(made[name]() for name in names)):\n"
        "    stamp = made['stamp_file'](step.name)\n"
        "    stamp.parent.mkdir(parents=True, exist_ok=True)\n"
        "    stamp.write_text(made['digest_of'](step.sources))\n"
    )
    subprocess.run([sys.executable, "-c", program], cwd=root, check=True)
    return root


def fresh(root: Path, lock: str) -> Path:
    clone(root, lock)
    shutil.rmtree(root / ".venv")
    shutil.rmtree(root / "frontend" / "dist")
    return root


def test_an_equal_environment_and_page_are_linked_with_the_new_path(tmp_path) -> None:
    ours, other = stamped(clone(tmp_path / "ours", "1")), fresh(tmp_path / "other", "1")
    assert reuse(ours, other) == [".venv", "frontend/dist"]
    assert (other / ".venv/bin/uv").samefile(ours / ".venv/bin/uv")
    assert (other / ".venv/bin/bt-studio").read_text() == f"#!{other}/.venv/bin/python\n"
    assert (ours / ".venv/bin/bt-studio").read_text() == f"#!{ours}/.venv/bin/python\n"
    assert {path.name for path in (other / "var/setup").iterdir()} == {
        *("python", "packages-test", "bt-studio", "front-end")
    }
    before = {path: path.read_text() for path in (other / "var/setup").iterdir()}
    stamped(other)
    assert before == {path: path.read_text() for path in (other / "var/setup").iterdir()}


def test_an_environment_of_another_lock_is_not_linked(tmp_path) -> None:
    ours, other = stamped(clone(tmp_path / "ours", "1")), fresh(tmp_path / "other", "1")
    (other / "requirements.lock").write_text("2")
    assert reuse(ours, other) == [".venv", "frontend/dist"], "the lock of the tests has that of `run` in it"
    (other / "requirements-dev.lock").write_text("2")
    shutil.rmtree(other / ".venv")
    assert reuse(ours, other) == []


def test_what_is_not_current_here_is_not_linked(tmp_path) -> None:
    ours, other = clone(tmp_path / "ours", "1"), fresh(tmp_path / "other", "1")
    assert reuse(ours, other) == []


def test_a_copy_that_was_interrupted_does_not_count(tmp_path) -> None:
    source = tmp_path / "source"
    source.mkdir()
    (source / "file").write_text("whole")
    part = tmp_path / "part"
    part.mkdir()
    (part / "half").touch()
    link_tree(source, tmp_path / "target", part, rewritten=("a", "b"))
    assert [path.name for path in (tmp_path / "target").iterdir()] == ["file"]
    assert not part.exists()


SET_UP = """
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
if not (ROOT / ".venv").exists():
    venv.create(ROOT / ".venv", symlinks=True)
"""
BENCHMARK = """
import sys
from product import answer
from tests.benchmarks.figures import Figure, show


def measure(options=()):
    yield Figure("answer", answer(), "ms")
    yield Figure("options", len(options), "")


def main():
    show(measure(sys.argv[1:]))
"""
WAITS = """
import pathlib, tempfile, time


def main():
    with tempfile.TemporaryDirectory(prefix="waits-") as folder:
        pathlib.Path({mark!r}).write_text(folder)
        time.sleep(1000)
"""


def git(root: Path, *arguments: str) -> str:
    who = ("-c", "user.name=a", "-c", "user.email=a@b.c")
    return subprocess.run(
        ["git", *who, *arguments], cwd=root, capture_output=True, text=True, check=True
    ).stdout.strip()


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository with the real command, a product of one function and a benchmark of it."""
    root = tmp_path / "tiny"
    benchmarks = root / "tests" / "benchmarks"
    shutil.copytree(ROOT / "tests" / "benchmarks" / "beside", benchmarks / "beside")
    for name in ("__init__", "__main__", "figures", "timing"):
        shutil.copy(ROOT / "tests" / "benchmarks" / f"{name}.py", benchmarks)
    (benchmarks / "behaviours.py").write_text(BENCHMARK)
    (root / "backend" / "setup").mkdir(parents=True)
    (root / "backend" / "setup" / "__main__.py").write_text(SET_UP)
    (root / "product.py").write_text("def answer():\n    return 4\n")
    (root / ".gitignore").write_text("/var/\n/.venv/\n__pycache__/\n")
    git(root, "init", "--quiet")
    git(root, "add", "--all")
    git(root, "commit", "--quiet", "--message", "Begin")
    return root


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "tests.benchmarks", *arguments]


def compare(root: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(*arguments), cwd=root, capture_output=True, text=True, check=False, timeout=2 * DEADLINE_S
    )


def test_a_change_is_measured_beside_its_commit(repository, tmp_path) -> None:
    (repository / "product.py").write_text("def answer():\n    return 1\n")
    lines = tmp_path / "pairs.jsonl"
    options = ("--more", "7", "--beside", "HEAD", "--pairs", "2", "--json", str(lines))
    done = compare(repository, "behaviours", *options)
    assert done.returncode == 0, done.stderr
    commit = git(repository, "rev-parse", "HEAD")
    assert f"this tree {commit[:12]} with uncommitted changes, beside {commit[:12]}" in done.stdout
    assert "cores, " in done.stdout
    assert "load at the start" in done.stdout
    (answer,) = (line for line in done.stdout.splitlines() if line.startswith("answer "))
    assert answer.split() == [
        *("answer", "ms", "1", "4", "0.250", "0.250…0.250", "0.250…0.250"),
        *("no", "difference", "shown"),
    ]
    pairs = [json.loads(line) for line in lines.read_text().splitlines()]
    assert [(pair["pair"], pair["benchmark"], pair["changed"], pair["beside"]) for pair in pairs] == [
        (1, "behaviours", True, commit),
        (2, "behaviours", True, commit),
    ]
    assert pairs[0]["figures"]["options"]["this_tree"] == 2, "an option that is not ours is the benchmark's"
    assert pairs[0]["figures"]["all its processes: processor time"]["ratio"] > 0
    kept = repository / "var" / "beside" / commit[:12] / "tree"
    assert str(kept) in git(repository, "worktree", "list"), "it is kept for the next time"

    (kept / "product.py").write_text("broken")
    refused = compare(repository, "behaviours", "--beside", "HEAD")
    assert refused.returncode == 1
    assert refused.stderr.count("\n") == 1
    assert "has uncommitted changes" in refused.stderr

    assert compare(repository, "--beside", "HEAD", "--clean").returncode == 0
    assert not kept.parent.exists()
    assert git(repository, "worktree", "list").count("\n") == 0


def test_a_revision_that_todays_benchmark_does_not_fit_runs_its_own(repository) -> None:
    today = BENCHMARK.replace("answer()", "newer()").replace("import answer", "import newer")
    (repository / "tests" / "benchmarks" / "behaviours.py").write_text(today)
    (repository / "product.py").write_text("def newer():\n    return 1\n")
    done = compare(repository, "behaviours", "--beside", "HEAD", "--pairs", "1")
    assert done.returncode == 0, done.stderr
    assert "each tree runs its own, as a whole" in done.stdout
    assert "cannot import name 'newer'" in done.stdout
    assert "all its processes: processor time" in done.stdout


def test_an_interrupt_leaves_nothing_but_the_worktree(repository, tmp_path) -> None:
    mark = tmp_path / "folder"
    (repository / "tests" / "benchmarks" / "behaviours.py").write_text(WAITS.format(mark=str(mark)))
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with subprocess.Popen(
        command("behaviours", "--beside", "HEAD"),
        cwd=repository,
        env=os.environ | {"TMPDIR": str(temporary)},
        stderr=subprocess.PIPE,
        text=True,
    ) as running:
        deadline = time.monotonic() + DEADLINE_S
        while not mark.exists():
            assert running.poll() is None
            assert time.monotonic() < deadline
            time.sleep(0.05)
        below = psutil.Process(running.pid).children(recursive=True)
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=DEADLINE_S)
    assert running.returncode == 130
    assert "Interrupted" in said
    assert "Traceback" not in said
    assert len(below) == 2
    assert not any(process.is_running() for process in below)
    assert list(temporary.iterdir()) == []


def test_what_cannot_be_compared_is_said_in_one_sentence(repository, tmp_path, capsys) -> None:
    with pytest.raises(CannotCompareError, match="There is no revision 'nothing' here"):
        Beside(repository, "nothing")
    with pytest.raises(CannotCompareError, match="There is no revision '--help' here"):
        Beside(repository, "--help")
    with pytest.raises(CannotCompareError, match="is not a git checkout"):
        this_tree(tmp_path)
    assert main(["engin", "--beside", "HEAD"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("There is no benchmark 'engin'; there are engine,")
    assert all(name in said for name in BENCHMARKS)
    assert main(["--beside", "HEAD"]) == 2
    assert main(["engine", "--beside", "HEAD", "--pairs", "0"]) == 1
    assert capsys.readouterr().err.endswith("beside: --pairs is at least 1.\n")


def test_a_full_disk_is_said_before_anything_is_made(repository, monkeypatch) -> None:
    full = shutil.disk_usage(repository)._replace(free=10**8)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: full)
    beside = Beside(repository, "HEAD")
    with pytest.raises(CannotCompareError, match=r"0\.1 GB are free at .*, and 5 GB are needed"):
        beside.build()
    assert not beside.kept.exists()
