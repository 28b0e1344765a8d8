"""A Python file that builds a tree of py_trees runs in a child, which reads nothing else, without sockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.expansion.py_trees_apart import BuildError, build_apart

if TYPE_CHECKING:
    from pathlib import Path

HEAD = "import py_trees\nfrom speeds import FAST\n\n\n"
CLASS = """class Drive(py_trees.behaviour.Behaviour):
    def __init__(self, name, speed=0.1):
        super().__init__(name)

    def update(self):
        return py_trees.common.Status.SUCCESS


"""


def written(folder: Path, text: str) -> Path:
    (folder / "speeds.py").write_text("FAST = 0.5\n")
    file = folder / "robot_tree.py"
    file.write_text(HEAD + CLASS + text)
    return file


def refused(folder: Path, text: str, main: str = "") -> tuple[str, str, int]:
    with pytest.raises(BuildError) as error:
        build_apart(written(folder, text), main)
    return str(error.value), error.value.file.name, error.value.line


TREE = "def create_root():\n    return py_trees.decorators.Inverter('not', Drive('go', FAST))\n"


def test_the_tree_that_a_function_makes_is_described(tmp_path: Path) -> None:
    made = build_apart(written(tmp_path, TREE))
    leaf = {"module": "robot_tree", "class": "Drive", "kind": "leaf", "name": "go", "children": []}
    assert made == {
        "module": "robot_tree",
        "expression": "create_root()",
        "files": ["robot_tree.py", "speeds.py"],
        "root": {
            "module": "py_trees.decorators",
            "class": "Inverter",
            "kind": "decorator",
            "name": "not",
            "arguments": {},
            "children": [{**leaf, "arguments": {"speed": "0.5"}}],
        },
    }


def test_a_variable_is_named_where_there_are_several(tmp_path: Path) -> None:
    text = "a = py_trees.trees.BehaviourTree(Drive('a'))\nb = py_trees.trees.BehaviourTree(Drive('b'))\n"
    assert refused(tmp_path, text)[0] == "it has several trees: a, b (name one with --main)"
    assert build_apart(tmp_path / "robot_tree.py", "b")["expression"] == "b.root"
    assert "it has no 'c'" in refused(tmp_path, text, "c")[0]


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        ("x = 1 / 0\n", "ZeroDivisionError: division by zero", 13),
        ("x = 1\n", "it makes no tree of py_trees", 1),
        ("raise SystemExit(3)\n", "SystemExit: 3", 13),
        ("x = bytearray(1 << 30)\n", "MemoryError", 13),
    ],
)
def test_why_there_is_no_tree_is_said_with_its_line(
    tmp_path: Path, text: str, message: str, line: int
) -> None:
    said, file, at = refused(tmp_path, text)
    assert message in said
    assert (file, at) == ("robot_tree.py", line)


PROBES = """
import os, socket, subprocess
here = os.path.dirname(__file__)
done = []
for name, probe in {
    "reads outside": lambda: open(here + "/../secret").read(),
    "reads the system": lambda: open("/etc/passwd").read(),
    "lists outside": lambda: os.listdir(here + "/.."),
    "follows a link": lambda: open(here + "/link").read(),
    "writes": lambda: open(__file__, "a"),
    "removes": lambda: os.remove(__file__),
    "opens a socket": lambda: socket.socket(),
    "runs a program": lambda: subprocess.run(["true"]),
    "runs a shell": lambda: os.system("true"),
    "forks": lambda: os.fork(),
}.items():
    try:
        probe()
        done.append(name)
    except OSError:
        pass
raise ValueError(f"done: {done}")
"""


def test_the_file_reads_its_folder_and_reaches_nothing_else(tmp_path: Path) -> None:
    folder = tmp_path / "tree"
    folder.mkdir()
    (tmp_path / "secret").write_text("secret")
    (folder / "link").symlink_to(tmp_path / "secret")
    before = written(folder, PROBES).read_text()
    assert refused(folder, PROBES)[0] == "ValueError: done: []"
    assert (folder / "robot_tree.py").read_text() == before


def test_a_file_that_cannot_be_imported_by_its_name_is_refused(tmp_path: Path) -> None:
    file = written(tmp_path, TREE).rename(tmp_path / "my-tree.py")
    with pytest.raises(BuildError, match=r"^my-tree\.py cannot be imported: rename it"):
        build_apart(file)


@pytest.mark.parametrize(
    "answer",
    ["5", "[]", '{"error": 1}', '{"files": ["../x.py"]}', "[" * 20_000, "", '{"module": "a b"}', "{}"],
)
def test_an_answer_that_the_file_wrote_itself_is_not_trusted(tmp_path: Path, answer: str) -> None:
    text = f"import os, sys\nsys.__stdout__.write({answer!r})\nsys.__stdout__.flush()\nos._exit(0)\n"
    assert refused(tmp_path, text)[1:] == ("robot_tree.py", 1)


def test_the_child_starts_no_threads_for_numpy(tmp_path: Path) -> None:
    """A user who is not root may start no process there, and OpenBLAS ends one that cannot start threads."""
    text = (
        "import os\n\nroot = py_trees.behaviours.Success(os.environ.get('OPENBLAS_NUM_THREADS', 'as many'))\n"
    )
    assert build_apart(written(tmp_path, text))["root"]["name"] == "1"
