"""A robot, a world or a map of an unpacked upload, and why it cannot be made."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.uploads.work import ChoiceError, RefusedError, Wish, make
from tests.executor.uploads.zips import CART, MAP, WORLD

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


@pytest.fixture
def upload(tmp_path: Path) -> Path:
    return tmp_path / "upload"


def write(folder: Path, files: Mapping[str, bytes]) -> None:
    for path, data in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)


def wish(kind: str, main: str = "", name: str = "") -> Wish:
    return Wish(kind, main, name, {}, simplify=False)


def test_what_is_as_in_the_upload_is_named_by_its_path(upload: Path, tmp_path: Path) -> None:
    write(upload, {**WORLD, **MAP})
    made = make(upload, tmp_path / "scratch", wish("universe", "shop/worlds/yard.sdf", "mine"))
    files = {file["path"]: file.get("source") for file in made["files"]}
    assert files == {"universes/mine.yaml": None, "assets/mine/meshes/a.stl": "shop/models/crate/a.stl"}
    line = {"file": "shop/worlds/yard.sdf", "line": 1, "text": "<physics> has no counterpart here"}
    assert made["report"]["left_out"] == [line]
    walls = make(upload, tmp_path / "scratch", wish("universe", "flat/map.yaml"))
    assert (walls["path"], walls["things"]) == ("universes/map.yaml", 1)


def test_what_is_not_clear_is_asked(upload: Path, tmp_path: Path) -> None:
    write(upload, {"a/one.urdf": CART.encode(), "a/two.urdf": CART.encode()})
    outside = tmp_path / "out.urdf"
    outside.write_text(CART)
    for main, kind, count in (
        ("", "robot", 2),
        ("../out.urdf", "robot", 2),
        (str(outside), "robot", 2),
        ("", "universe", 0),
    ):
        with pytest.raises(ChoiceError) as error:
            make(upload, tmp_path / "scratch", wish(kind, main))
        assert len(error.value.items) == count


@pytest.mark.parametrize(
    ("file", "text", "line", "message"),
    [
        ("a/r.urdf", CART.replace("continuous", "fixed"), 1, "the robot cannot be imported: it has no wheel"),
        ("a/r.urdf", "<robot name='r'>\n<link", 2, "Couldn't find end of Start Tag"),
        ("a/r.urdf", CART.replace('<mass value="2"/>', '<mass value="nan"/>'), 1, "nan"),
        ("a/r.urdf", CART.replace('<mass value="2"/>', '<mass value="-1"/>'), 1, "mass"),
        (
            "a/w.sdf",
            "<sdf version='1.9'><world name='w'><physics/></world></sdf>",
            1,
            "nothing of this world",
        ),
        ("a/w.sdf", "<sdf version='99'><world name='w'/></sdf>", 1, "99"),
        ("a/w.sdf", "<sdf version='1.9'><world name='w'>\n<x></world></sdf>", 2, "mismatch"),
    ],
)
def test_what_cannot_be_made_has_file_and_line(  # noqa: PLR0917 - one a column
    upload: Path, tmp_path: Path, file: str, text: str, line: int, message: str
) -> None:
    write(upload, {file: text.encode()})
    with pytest.raises(RefusedError) as error:
        make(upload, tmp_path / "scratch", wish("robot" if file.endswith("urdf") else "universe"))
    first, *_ = error.value.diagnostics
    assert (first["file"].removeprefix(f"{upload}/"), first["line"]) == (file, line)
    assert message in str(error.value.diagnostics)
