"""The robots, worlds and maps in an upload."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.uploads.look import items, name_of
from tests.executor.uploads.zips import MAP, PACKAGE, WORLD

if TYPE_CHECKING:
    from pathlib import Path


def test_main_files_come_first_and_parts_of_others_last(tmp_path: Path) -> None:
    for path, data in {**PACKAGE, **WORLD, **MAP}.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(data)
    (tmp_path / "nav.yaml").write_text("resolution: 0.05\n")
    (tmp_path / "link.world").symlink_to(tmp_path / "shop" / "worlds" / "yard.sdf")
    found = [(item["kind"], item["source"], item["name"], item["is_main"]) for item in items(tmp_path)]
    assert found == [
        ("universe", "sdf", "yard", True),
        ("robot", "xacro", "cart", True),
        ("universe", "map", "map", True),
        ("robot", "sdf", "crate", False),
    ]


def test_a_name_is_that_of_the_file_or_of_the_model_s_folder(tmp_path: Path) -> None:
    names = {"a b.urdf.xacro": "a_b", "crate/model.sdf": "crate", "model.sdf": "imported"}
    assert {path: name_of(tmp_path / path, tmp_path) for path in names} == names
