"""A run that leaves something behind fails, and names it and its test file."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
from pathlib import Path

import psutil
import pytest

from tests.deadline import DEADLINE_S

ROOT = Path(__file__).parents[1]
SLEEPER = "[sys.executable, '-c', 'import time; time.sleep(600)']"
LEAKING = {
    "child": f"process = subprocess.Popen({SLEEPER}, start_new_session=True)",
    # Its parent has ended, and what it inherited names the run.
    "orphan": f"""
        source = "import subprocess, sys; subprocess.Popen({SLEEPER})"
        subprocess.run([sys.executable, "-c", source], check=True)
    """,
    "folder": "tempfile.mkdtemp(prefix='forgotten-')",
    "memory": "os.close(os.open('/dev/shm/' + os.environ['LEFT'], os.O_RDWR | os.O_CREAT)); keep()",
    "reused": """
        if hasattr(sys, "kept"):  # the memory of the test before is gone, and its name is another's now
            sys.kept.close()
            path = '/dev/shm/' + os.environ['LEFT']
            os.rename(path, path + '_old')
            os.close(os.open(path, os.O_RDWR | os.O_CREAT))
            os.unlink(path + '_old')
    """,
    "clean": f"""
        with tempfile.TemporaryDirectory(), subprocess.Popen({SLEEPER}) as process:
            process.kill()
        if hasattr(sys, "kept"):  # what is in use at the end of the session may still be removed
            sys.kept.close()
    """,
}
KEEP = """
import mmap, os, subprocess, sys, tempfile

def keep():
    with open('/dev/shm/' + os.environ['LEFT'], 'r+b') as file:
        file.write(bytes(100))
        file.flush()
        sys.kept = mmap.mmap(file.fileno(), 100)

"""


def run(folder: Path, *names: str, options: tuple[str, ...] = ()) -> subprocess.Popen[str]:
    for name in names:
        body = textwrap.indent(textwrap.dedent(LEAKING[name]).strip(), "    ")
        (folder / f"test_{name}.py").write_text(f"{KEEP}def test_it():\n{body}\n")
    return subprocess.Popen(
        [
            sys.executable,
            "-m",
            "pytest",
            "-p",
            "tests.leaks",
            *options,
            *(f"test_{name}.py" for name in names),
        ],
        cwd=folder,
        env=os.environ
        | {"PYTHONPATH": str(ROOT), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "LEFT": f"left_{os.getpid()}"},
        stdout=subprocess.PIPE,
        text=True,
    )


def test_each_leak_fails_the_run_by_name(tmp_path: Path) -> None:
    left = Path(f"/dev/shm/left_{os.getpid()}")  # noqa: S108 - it is what is tested
    try:
        with run(tmp_path, *(name for name in LEAKING if name != "reused")) as process:
            said, _ = process.communicate(timeout=DEADLINE_S)
        leaks = [line for line in said.splitlines() if line.startswith("ERROR")]
        processes = [line for line in leaks if "leaves a process behind" in line]
        assert [line.split()[1] for line in processes] == ["test_child.py", "test_orphan.py"]
        for line in processes:
            sleeper = psutil.Process(int(line.partition("behind: ")[2].split()[0]))
            assert "time.sleep(600)" in " ".join(sleeper.cmdline())
            sleeper.send_signal(signal.SIGKILL)
        assert any("test_folder.py - leaves a temporary file behind: " in line for line in leaks)
        assert any("test_memory.py - leaves shared memory behind: " in line for line in leaks)
        assert len(leaks) == 4, said
        assert process.returncode == pytest.ExitCode.TESTS_FAILED
    finally:
        left.unlink(missing_ok=True)


def test_a_name_that_another_uses_now_does_not_count(tmp_path: Path) -> None:
    left = Path(f"/dev/shm/left_{os.getpid()}")  # noqa: S108 - as above
    try:
        with run(tmp_path, "memory", "reused") as process:
            said, _ = process.communicate(timeout=DEADLINE_S)
        assert left.exists()
        assert process.returncode == 0, said
    finally:
        left.unlink(missing_ok=True)


def test_what_another_run_leaves_does_not_count(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    with run(tmp_path / "other", "child", "folder") as other, run(tmp_path, "clean") as ours:
        leaking, _ = other.communicate(timeout=DEADLINE_S)
        clean, _ = ours.communicate(timeout=DEADLINE_S)
    line = next(line for line in leaking.splitlines() if "leaves a process behind" in line)
    psutil.Process(int(line.partition("behind: ")[2].split()[0])).kill()
    assert ours.returncode == 0, clean
    assert "behind:" not in clean


def test_what_one_of_several_processes_leaves_fails_the_run(tmp_path: Path) -> None:
    with run(
        tmp_path, "clean", "folder", options=("-p", "xdist.plugin", "-n2", "--dist=loadfile")
    ) as process:
        said, _ = process.communicate(timeout=DEADLINE_S)
    leaks = [line for line in said.splitlines() if line.startswith("ERROR")]
    assert ["test_folder.py - leaves a temporary file behind" in line for line in leaks] == [True], said
    assert process.returncode == pytest.ExitCode.TESTS_FAILED
