"""It is known which functions ran in a test: in its process, in children, in processes that serve many."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.tools.measuring.executed import Ran, lanes, path_hash
from tests.tools.measuring.install import build
from tests.tools.measuring.results import measured
from tests.tools.selection.table import ROOT

if TYPE_CHECKING:
    from tests.tools.measuring.results import Measured

PRODUCT = """
    import functools, sys

    def direct(): ...
    def in_child(): ...
    def in_killed(): ...
    def in_thread(): ...
    def at_start(): ...
    def in_request(): ...
    def never(): ...
    def shared(): ...
    def below(): ...
    @functools.cache
    def cached(): below()
    def recurse(n): return recurse(n - 1) if n else 0
    def serve():
        at_start()
        print("ready", flush=True)
        for line in sys.stdin:
            globals()[line.strip()]()
            print("done", flush=True)
"""
FIRST = """
    import os, signal, subprocess, sys, threading
    import pytest
    import product

    @pytest.fixture(scope="session")
    def server():
        product.shared()
        command = [sys.executable, "-c", "import product; product.serve()"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            process.stdout.readline()
            yield process
            process.stdin.close()

    def ask(server, name):
        server.stdin.write(name + chr(10)); server.stdin.flush(); server.stdout.readline()

    def test_direct():
        product.direct(); product.cached()

    def test_again():
        product.direct(); product.cached()

    def test_thread():
        thread = threading.Thread(target=product.in_thread)
        thread.start(); thread.join()

    def test_fork():
        if (pid := os.fork()) == 0:
            product.in_child()
            os._exit(0)
        os.waitpid(pid, 0)

    def test_killed():
        code = "import os, product; product.in_killed(); os.closerange(3, 99); os.kill(os.getpid(), 9)"
        subprocess.run([sys.executable, "-c", code])

    def test_without_variables():
        subprocess.run([sys.executable, "-c", "import product; product.in_child()"], env={PATHS})

    def test_request(server):
        ask(server, "in_request")

    def test_other_request(server):
        ask(server, "direct")

    def test_deep():
        sys.setrecursionlimit(20_000)
        assert product.recurse(9_000) == 0
"""


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    """A small separate run of pytest, whose tree is a folder of two modules."""
    folder = tmp_path_factory.mktemp("run")
    site, root, data = folder / "site", folder / "root", folder / "data"
    for each in (site, root, data / "loaded", data / "executed"):
        each.mkdir(parents=True)
    if problem := build(site / "_bt_studio_executed.so"):
        raise AssertionError(problem)
    loaded = (ROOT / "tests/tools/measuring/loaded.py").read_text()
    # A measured run of the suite notes itself what processes read.
    begin = f"\nsys.__dict__.pop('bt_studio_log', None)\nbegin({str(data / 'loaded')!r}, {str(root)!r})\n"
    (site / "sitecustomize.py").write_text(loaded + begin)
    paths = {"PYTHONPATH": os.pathsep.join(map(str, (site, root, ROOT)))}
    (root / "product.py").write_text(textwrap.dedent(PRODUCT))
    (root / "test_first.py").write_text(textwrap.dedent(FIRST).replace("{PATHS}", repr(paths)))
    keeper = path_hash("product.py") << 32 | _line("@functools.cache")
    (data / "keepers").write_bytes(keeper.to_bytes(8, "little"))
    environment = {name: value for name, value in os.environ.items() if name != "BT_STUDIO_EXECUTED"}
    environment |= paths | {"BT_STUDIO_MEASURE": str(data), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    plugin = ["-p", "tests.tools.measuring.plugin", "-p", "no:cacheprovider", "-c", os.devnull]
    command = [sys.executable, "-m", "pytest", *plugin, "--rootdir", str(root), str(root / "test_first.py")]
    result = subprocess.run(command, check=False, env=environment, cwd=root, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    return measured(data, ["product.py", "test_first.py"])


def _line(text: str) -> int:
    return textwrap.dedent(PRODUCT).splitlines().index(text) + 1


def ran(found: Measured, name: str) -> set[str]:
    (own,) = _ran(found, name).values()
    return _names(own.places)


def _ran(found: Measured, name: str) -> dict[str, Ran]:
    test = next(test for test in found.processor_s if test.endswith(f"::{name}"))
    return found.ran(frozenset({test}))


def _names(places: set[tuple[str, int]]) -> set[str]:
    lines = textwrap.dedent(PRODUCT).splitlines()
    names = (lines[line - 1] for path, line in places if path == "product.py" and line)
    return {line.removeprefix("def ").partition("(")[0] for line in names}


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        ("test_direct", {"direct", "@functools.cache", "below"}),
        ("test_thread", {"in_thread"}),
        ("test_fork", {"in_child"}),
        ("test_killed", {"in_killed"}),
        ("test_without_variables", {"in_child"}),
    ],
)
def test_what_ran_in_a_test_and_in_its_children(found, test, expected):
    assert ran(found, test) == expected


def test_what_was_cached_before_is_kept(found):
    assert ran(found, "test_again") == {"direct"}
    (own,) = _ran(found, "test_again").values()
    assert {"@functools.cache", "below"} <= _names(own.kept)
    assert "in_thread" not in _names(own.kept)


def test_a_process_that_serves_many_brings_its_start_and_not_what_it_did_for_others(found):
    start = {"shared", "serve", "at_start"}
    assert ran(found, "test_request") == start | {"in_request"}
    assert ran(found, "test_other_request") == start | {"direct"}
    assert not ran(found, "test_thread") & start


def test_what_a_very_deep_recursion_runs_is_not_known(found):
    assert _ran(found, "test_deep") == {}


def test_modules_of_children_are_known(found):
    (own,) = _ran(found, "test_killed").values()
    assert ("product.py", 0) in own.places


def test_where_functions_are_not_noted_nothing_is_known(tmp_path):
    (tmp_path / "loaded").mkdir()
    assert lanes(tmp_path, ["a.py"]) == {}
    assert "no-such" in build(Path("/no-such/folder/x.so"))
