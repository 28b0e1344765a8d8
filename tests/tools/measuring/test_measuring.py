"""A measured run knows what its tests cost and what their processes read."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

from tests.tools.measuring.processor_time import ProcessorTime
from tests.tools.measuring.results import measured
from tests.tools.selection.table import ROOT

BURN = "import time\nend = time.process_time() + {}\nwhile time.process_time() < end: pass\n"


def burn(seconds: float) -> list[str]:
    return [sys.executable, "-c", BURN.format(seconds)]


def test_processor_time_counts_children_that_ended_and_those_that_live():
    clock = ProcessorTime()
    before_s = clock.read()
    subprocess.run(burn(0.3), check=True)
    ended_s = clock.read()
    assert ended_s - before_s >= 0.29
    with subprocess.Popen(
        [sys.executable, "-c", BURN.format(0.3) + "print(flush=True)\ninput()"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as alive:
        alive.stdout.readline()
        living_s = clock.read()
        assert living_s - ended_s >= 0.29
        assert alive.pid in {pid for pid, _ in clock.alive}
        alive.communicate(b"\n")
    assert clock.read() >= living_s


def test_the_time_of_an_orphan_is_not_lost():
    clock = ProcessorTime()
    orphan = BURN.format(0.3) + "print(flush=True)\ninput()"
    leaver = f"import subprocess, sys; subprocess.Popen([sys.executable, '-c', {orphan!r}]); input()"
    with subprocess.Popen(
        [sys.executable, "-c", leaver], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        parent.stdout.readline()
        before_s = clock.read()
        parent.kill()
        parent.wait()
        assert clock.read() >= before_s
        parent.stdin.close()
        parent.stdout.read()  # ends with the orphan
    assert clock.read() >= before_s


PROGRAM = """
    import os, subprocess, sys
    from pathlib import Path

    def test_forks():
        child = os.fork()
        if child == 0:
            import translator.limits
            os._exit(0)
        os.waitpid(child, 0)

    def test_starts():
        code = "import translator.values; open('translator/diagnostics.json').close()"
        subprocess.run([sys.executable, "-c", code], check=True, cwd=ROOT)
"""


def test_what_processes_read_is_known_by_file(tmp_path):
    """A small run of pytest with its own environment of packages, in which processes note what they read."""
    (tmp_path / "site").mkdir()
    logs = tmp_path / "measured" / "loaded"
    logs.mkdir(parents=True)
    loaded = (ROOT / "tests/tools/measuring/loaded.py").read_text()
    # A measured run of the suite notes itself what processes read.
    begin = f"\nsys.__dict__.pop('bt_studio_log', None)\nbegin({str(logs)!r}, {str(ROOT)!r})\n"
    (tmp_path / "site" / "sitecustomize.py").write_text(loaded + begin)
    program = tmp_path / "test_program.py"
    program.write_text(f"ROOT = {str(ROOT)!r}\n" + textwrap.dedent(PROGRAM))
    empty = tmp_path / "test_empty.py"
    empty.write_text("def test_nothing():\n    assert True\n")
    plugin = ["-p", "tests.tools.measuring.plugin", "-p", "no:cacheprovider", "-c", os.devnull]
    outer = {name: value for name, value in os.environ.items() if name != "BT_STUDIO_EXECUTED"}
    environment = outer | {
        "PYTHONPATH": os.pathsep.join([str(tmp_path / "site"), str(ROOT)]),
        "BT_STUDIO_MEASURE": str(tmp_path / "measured"),
        "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, "-m", "pytest", *plugin, "--rootdir", str(tmp_path), str(program), str(empty)]
    subprocess.run(command, check=True, env=environment, cwd=tmp_path, capture_output=True)
    found = measured(tmp_path / "measured")
    names = {Path(test).name for test in found.processor_s}
    assert names == {
        "test_empty.py::test_nothing",
        "test_program.py::test_starts",
        "test_program.py::test_forks",
    }
    assert found.failed == set()
    read = found.loaded["test_program.py"]
    assert {"translator/values.py", "translator/diagnostics.json", "translator/limits.py"} <= read
    assert not any(path.startswith(".venv") for path in read)
    assert found.loaded["test_empty.py"] == set()
