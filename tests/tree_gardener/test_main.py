"""The command lines: ``python -m tree_gardener`` and ``bt-studio conformance``."""

from __future__ import annotations

import json
import threading
from typing import TYPE_CHECKING

import pytest

from backend.cli import conformance as verb
from backend.cli.shared.errors import CliError
from tests.tree_gardener.debugging.hooked import free_port, hook_of
from tests.tree_gardener.groot.zmtp import Groot2
from tests.tree_gardener.trees import subtree
from tree_gardener import Status
from tree_gardener.__main__ import main
from tree_gardener.debugging import Force

if TYPE_CHECKING:
    from pathlib import Path

GO = """import py_trees

class Go(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.{}
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    path = tmp_path / "tree.xml"
    path.write_text(f"<root>{subtree('M', '<Sequence><Go/><AlwaysSuccess/></Sequence>')}</root>")
    (tmp_path / "actions").mkdir()
    return path


def run(tree: Path, status: str, *options: str) -> int:
    (tree.parent / "actions" / "Go.py").write_text(GO.format(status))
    return main(["run", str(tree), "--actions", str(tree.parent / "actions"), "--tick-hz", "500", *options])


def test_a_tree_runs_to_its_end(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tree, "SUCCESS", "--trace") == 0
    out = capsys.readouterr().out
    assert "tick 1: Go::2 SUCCESS" in out
    assert out.endswith("the root returned SUCCESS\n")
    assert run(tree, "FAILURE") == 1


def test_ticks_can_be_limited(tree: Path) -> None:
    assert run(tree, "RUNNING", "--max-ticks", "3") == 1
    assert run(tree, "SUCCESS", "--repeat", "--max-ticks", "3") == 0


def test_a_run_is_followed_by_groot2(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    port = free_port()
    seen: list[bytes] = []

    def follow() -> None:
        client = Groot2.as_soon_as_served(port)
        seen.extend([client.ask("T")[0], client.ask("S")[0]])
        client.insert_hooks([hook_of(Force(1, Status.SUCCESS), 0)])
        client.close()

    thread = threading.Thread(target=follow)
    thread.start()
    assert run(tree, "RUNNING", "--groot2", str(port)) == 0
    thread.join()
    assert b"<Go " in seen[0]
    assert len(seen[1]) == 9
    assert main(["run", str(tree), "--actions", str(tree.parent / "actions"), "--groot2", "70000"]) == 2
    assert "port 70000" in capsys.readouterr().err


def test_what_cannot_run_says_why(tree: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(tree)]) == 1
    assert "TG209 there is no node 'Go'" in capsys.readouterr().err
    assert main(["run", str(tree.parent / "no.xml")]) == 2
    assert run(tree, "NOTHING") == 1
    assert "actions/Go.py" in capsys.readouterr().err


GOOD = {
    "name": "good",
    "xml": '<root><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>',
    "ticks": 1,
    "expected": [{"root": "SUCCESS", "status": "I"}],
}


def test_conformance_counts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cases.jsonl"
    path.write_text(json.dumps(GOOD) + "\n")
    verb.conformance([path])
    assert capsys.readouterr().out == "1 passed, 0 failed\n"
    bad = {**GOOD, "name": "bad", "expected": [{"root": "FAILURE", "status": "I"}]}
    path.write_text(json.dumps(GOOD) + "\n" + json.dumps(bad) + "\n")
    with pytest.raises(CliError):
        verb.conformance([path])
    out = capsys.readouterr().out
    assert "bad\n    tick 0: root: expected FAILURE, got SUCCESS" in out
    assert out.endswith("1 passed, 1 failed\n")
    with pytest.raises(CliError):
        verb.conformance([path], as_json=True)
    assert json.loads(capsys.readouterr().out.splitlines()[0]) == {
        "name": "good",
        "differences": [],
        "deviation": "",
    }


@pytest.mark.parametrize("text", ["no json", "[1]", '{"name": "x"}'])
def test_conformance_refuses_other_files(tmp_path: Path, text: str) -> None:
    path = tmp_path / "cases.jsonl"
    path.write_text(text)
    for paths in ([path], [tmp_path / "missing.jsonl"]):
        with pytest.raises(CliError) as refused:
            verb.conformance(paths)
        assert refused.value.status == 2
