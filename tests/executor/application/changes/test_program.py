"""The project whose tree runs, and a changed one that is loaded beside it."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path

import pytest

from executor.application.changes.program import NoTreeError, Program
from tests.executor.application.real_application import action
from tree_gardener import LoadError, ManualClock

TREE = "<Sequence _bts_id='s'><Act _bts_id='a'/><Other _bts_id='o'/></Sequence>"


def written(folder: Path, tree: str = TREE, *, helper: str = "", extra: str = "", **actions: str) -> Path:
    folder.mkdir()
    code = "".join(
        f"<Action name='{name}'><![CDATA[{source.replace('class Act(', f'class {name}(')}]]></Action>"
        for name, source in actions.items()
    )
    text = f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{tree}</BehaviorTree><Code>{code}</Code></root>"
    (folder / "self_contained_tree.xml").write_text(text)
    if helper:
        (folder / "helper.py").write_text(helper)
    if extra:
        (folder / "extra.txt").write_text(extra)
    return folder


RUNS = action("def update(self):\n    return Status.RUNNING")
ENDS = action("def update(self):\n    return Status.SUCCESS")
HELPED = "import helper\n" + action(
    "def update(self):\n    return Status.RUNNING if helper.WAITS else Status.SUCCESS"
)


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Makes a program in a folder, and leaves no trace of it."""
    monkeypatch.chdir(tmp_path)
    paths, modules = list(sys.path), dict(sys.modules)
    yield lambda folder: Program(folder, ManualClock())
    sys.path[:] = paths
    for name in [name for name in sys.modules if name not in modules]:
        del sys.modules[name]


def test_an_action_whose_code_is_the_same_keeps_its_class(program, tmp_path: Path):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    tree = running.load()
    classes = [type(node.behaviour) for node in tree.nodes[1:]]
    change = running.change(written(tmp_path / "2", Act=RUNS, Other=RUNS), tree)
    again = [type(node.behaviour) for node in change.swap.new.nodes[1:]]
    assert again[0] is classes[0]
    assert again[1] is not classes[1]
    assert Path.cwd() == tmp_path / "2"


def test_an_action_changes_with_a_module_that_it_imports(program, tmp_path: Path):
    running = program(written(tmp_path / "1", helper="WAITS = True", Act=HELPED, Other=ENDS))
    tree = running.load()
    tree.tick_exactly_once()
    same = running.change(written(tmp_path / "2", helper="WAITS = True", Act=HELPED, Other=ENDS), tree)
    assert same.swap.plan.halted == ()
    same.undo()
    change = running.change(written(tmp_path / "3", helper="WAITS = False", Act=HELPED, Other=ENDS), tree)
    assert change.swap.plan.halted == (("a",),)
    assert change.swap.run().tick_exactly_once().name == "SUCCESS"


def test_a_change_that_is_undone_leaves_folder_modules_and_classes(program, tmp_path: Path):
    running = program(written(tmp_path / "1", helper="WAITS = True", Act=HELPED, Other=ENDS))
    tree = running.load()
    before = sys.modules["actions.Act"], sys.modules["helper"], list(sys.path), list(sys.meta_path)
    change = running.change(written(tmp_path / "2", helper="WAITS = False", Act=HELPED, Other=RUNS), tree)
    change.undo()
    assert (sys.modules["actions.Act"], sys.modules["helper"], sys.path, sys.meta_path) == before
    assert Path.cwd() == tmp_path / "1"
    assert tree.tick_exactly_once().name == "RUNNING"


def test_files_have_the_names_and_texts_of_the_project(program, tmp_path: Path):
    first = written(tmp_path / "1", helper="WAITS = True\n", Act=HELPED, Other=ENDS)
    running = program(first)
    tree = running.load()
    module = sys.modules["helper"].__file__
    assert module == str(first / "helper.py")
    assert (running.file_of(module), running.text_of(module, 100)) == ("helper.py", "WAITS = True\n")
    assert running.file_of("actions/Act.py") == "actions/Act.py"
    assert running.text_of("actions/Act.py", 1000) == HELPED
    assert running.text_of("actions/Act.py", 10) is None
    assert running.text_of(module, 5) is None
    for other in (os.__file__, f"{first}2/x.py", "<string>"):
        assert running.file_of(other) == ""

    change = running.change(written(tmp_path / "2", helper="WAITS = True\n", Act=HELPED, Other=RUNS), tree)
    assert sys.modules["helper"].__file__ == module, "it has not changed"
    assert (running.file_of(module), running.text_of(module, 100)) == ("helper.py", "WAITS = True\n")
    assert running.text_of("actions/Other.py", 1000) == RUNS.replace("class Act(", "class Other(")
    assert running.file_of(str(tmp_path / "2/lib/x.py")) == "lib/x.py"
    change.undo()
    assert running.file_of(str(tmp_path / "2/lib/x.py")) == ""
    assert running.text_of("actions/Other.py", 1000) == ENDS.replace("class Act(", "class Other(")


def test_bytes_that_are_not_utf_8_count_as_what_is_shown_for_them(program, tmp_path: Path):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    file = tmp_path / "1/odd.py"
    file.write_bytes(b"\xff" * 100)
    assert running.text_of(str(file), 299) is None
    assert running.text_of(str(file), 300) == "\N{REPLACEMENT CHARACTER}" * 100
    for no_room in (0, -1, -1000):
        assert running.text_of(str(file), no_room) is None
        assert running.text_of("actions/Act.py", no_room) is None


def test_no_more_of_a_file_is_read_than_there_is_room_for(program, tmp_path: Path, monkeypatch):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    file = tmp_path / "1/long.py"
    file.write_bytes(b"x" * 100)
    sizes = []

    class Opened(io.BytesIO):
        def read(self, size: int | None = -1) -> bytes:
            sizes.append(size)
            return super().read(size)

    with monkeypatch.context() as patched:
        patched.setattr(Path, "open", lambda path, _mode: Opened(b"x" * 100))
        assert [running.text_of(str(file), room) for room in (-1000, -1, 0, 7)] == [None] * 4
    assert sizes == [0, 0, 1, 8]


def test_a_file_that_is_gone_or_no_file_has_no_text(program, tmp_path: Path):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    os.mkfifo(tmp_path / "1/pipe.py")
    for name in ("pipe.py", "gone.py", ".", "a\0b.py"):
        assert running.text_of(str(tmp_path / "1" / name), 100) is None


@pytest.mark.parametrize(
    ("tree", "code", "text"),
    [
        ("<Sequence _bts_id='s'/>", RUNS, "Sequence has 0 children"),
        (TREE, "def", "Python cannot read it"),
        (TREE, "raise ValueError('no')", "ValueError: no"),
    ],
)
def test_a_project_that_does_not_load_changes_nothing(program, tmp_path: Path, tree, code, text):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    old = running.load()
    module = sys.modules["actions.Act"]
    with pytest.raises(LoadError, match=text):
        running.change(written(tmp_path / "2", tree, Act=code, Other=ENDS), old)
    assert sys.modules["actions.Act"] is module
    assert Path.cwd() == tmp_path / "1"


def test_a_folder_without_a_project_is_refused_and_a_later_change_works(program, tmp_path: Path):
    running = program(written(tmp_path / "1", Act=RUNS, Other=ENDS))
    tree = running.load()
    (tmp_path / "2").mkdir()
    for folder in (tmp_path / "2", tmp_path / "nowhere"):
        with pytest.raises(NoTreeError, match="the project has no"):
            running.change(folder, tree)
    assert Path.cwd() == tmp_path / "1"
    assert running.change(written(tmp_path / "3", Act=RUNS, Other=ENDS), tree).swap.plan.halted == ()
