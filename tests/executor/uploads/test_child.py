"""The child unpacks an upload, and answers what it holds or what it makes of it."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from executor.uploads import child
from tests.backend.disks import small_disk
from tests.executor.uploads.zips import PACKAGE, triangles, zipped

if TYPE_CHECKING:
    from pathlib import Path


def asked(folder: Path, data: bytes, *before: str, **wish: Any) -> dict[str, Any]:
    header = {
        "filename": "a.zip",
        "kind": "",
        "main": "",
        "name": "",
        "arguments": {},
        "simplify": False,
    } | wish
    folder.mkdir()
    done = subprocess.run(
        [*before, sys.executable, "-m", child.__name__.rpartition(".")[0], str(folder)],
        input=json.dumps(header).encode() + b"\n" + data,
        capture_output=True,
        check=True,
    )
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def test_it_answers_what_an_upload_holds_and_names_no_path_of_the_machine(tmp_path: Path) -> None:
    held = asked(tmp_path / "one", zipped(PACKAGE))
    assert [item["path"] for item in held["items"]] == ["ws/cart/urdf/cart.urdf.xacro"]
    made = asked(tmp_path / "two", zipped(PACKAGE), kind="robot", name="mine")
    sources = {file["path"]: file.get("source") for file in made["files"]}
    assert sources == {
        "robots/mine/meshes/lid.stl": "ws/cart/meshes/lid.stl",
        "robots/mine/mine.urdf": None,
        "robots/mine/robot.yaml": None,
    }
    assert str(tmp_path) not in json.dumps(made)
    assert sorted(path.name for path in (tmp_path / "two").iterdir() if path.name != "project") == ["upload"]


def test_an_upload_that_cannot_be_read_is_refused_with_the_reason(tmp_path: Path) -> None:
    assert asked(tmp_path / "one", b"no zip")["error"]["code"] == "bad_archive"
    most = {f"a{number}": "🤖" * 2_000 for number in range(100)}
    assert asked(tmp_path / "two", b"no zip", arguments=most)["error"]["code"] == "bad_archive"
    unforeseen = asked(tmp_path / "three", zipped(PACKAGE), kind="robot", arguments=[1])["error"]
    assert unforeseen == {"code": "refused", "message": "It cannot be read: TypeError."}


def test_a_python_file_runs_in_a_child_of_its_own_and_nothing_else_does(tmp_path: Path) -> None:
    source = b"import py_trees\n\nroot = py_trees.behaviours.Success('s')\n"
    made = asked(tmp_path / "one", source, filename="robot.py", kind="tree")
    assert {"trees/MainTree.json", "actions/robot.py"} <= {file["path"] for file in made["files"]}
    outside = f"root = open({str(tmp_path / 'secret')!r}).read()\n".encode()
    (tmp_path / "secret").write_text("x")
    refused = asked(tmp_path / "two", outside, filename="robot.py", kind="tree")["no_tree"]
    assert "PermissionError" in refused["message"]
    zipped_up = asked(tmp_path / "three", zipped(PACKAGE), filename="robot.py", kind="tree")
    assert zipped_up["error"] == {"code": "bad_archive", "message": "This is not one Python file."}


def test_a_full_disk_is_reported_and_nothing_is_made(tmp_path: Path) -> None:
    large = PACKAGE | {"ws/cart/meshes/lid.stl": triangles(60_000)}  # 3 MB, and little in the zip
    with small_disk(tmp_path / "disk", 1) as disk:
        answer = asked(tmp_path / "disk" / "one", zipped(large), *disk.prefix, kind="robot")
        assert answer["error"]["code"] == ("disk_full" if disk.mounted else "too_large")
        assert "is full" in answer["error"]["message"] or "larger" in answer["error"]["message"]


def test_levels_of_includes_have_an_end_with_file_and_line(tmp_path: Path) -> None:
    macro = '<robot xmlns:xacro="http://x">\n<xacro:include filename="x{}.xacro"/></robot>'
    chain = {f"r/x{number}.xacro": macro.format(number + 1).encode() for number in range(40)}
    chain |= {"r/x40.xacro": b'<robot name="r"/>'}
    [found] = asked(tmp_path / "one", zipped(chain), kind="robot", main="r/x0.xacro")["error"]["diagnostics"]
    assert (found["file"], found["line"]) == ("r/x31.xacro", 2)
    assert "more than 32 levels deep" in found["message"]
    model = "<sdf version='1.9'><model name='m{}'>\n{}</model></sdf>"
    models = {
        path: data
        for number in range(40)
        for path, data in {
            f"w/m{number}/model.config": f"<model><name>m{number}</name><sdf>m.sdf</sdf></model>".encode(),
            f"w/m{number}/m.sdf": model.format(
                number, f"<include><uri>model://m{number + 1}</uri></include>"
            ).encode(),
        }.items()
    }
    world = b"<sdf version='1.9'><world name='w'><include><uri>model://m0</uri></include></world></sdf>"
    made = asked(tmp_path / "two", zipped({"w/w.sdf": world} | models), kind="universe", main="w/w.sdf")
    assert "32" in json.dumps(made)
    assert "levels" in json.dumps(made) or "deep" in json.dumps(made)
