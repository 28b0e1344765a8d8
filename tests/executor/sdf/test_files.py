"""Files that a document names are found in memory and on the disk alike."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.sdf.files import DiskFiles, Files, MemoryFiles, NoFiles, model_file
from tree_gardener.packages import PackageError, Packages, Place

if TYPE_CHECKING:
    from pathlib import Path

FILES = {
    "shop/models/crate/model.config": b"<model><name>Crate</name><sdf version='1.5'>old.sdf</sdf>"
    b"<sdf version='1.9'>new.sdf</sdf><sdf version='1.99'>later.sdf</sdf></model>",
    "shop/models/crate/new.sdf": b"new",
    "shop/models/set/cup/model.sdf": b"cup",
    "shop/worlds/a.sdf": b"world",
    "shop/worlds/near.stl": b"mesh",
}


@pytest.fixture(params=["memory", "disk"])
def files(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Files, str]:
    if request.param == "memory":
        return MemoryFiles(FILES), ""
    for path, raw in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(raw)
    return DiskFiles(Packages(tmp_path, [Place("the project", tmp_path)])), f"{tmp_path}/"


@pytest.mark.parametrize(
    ("uri", "content"),
    [
        ("model://crate/new.sdf", b"new"),
        ("model://Crate", b"new"),
        ("crate", b"new"),
        ("https://fuel.gazebosim.org/1.0/someone/models/Crate/3/files/new.sdf", b"new"),
        ("near.stl", b"mesh"),
        ("model://set/cup", b"cup"),
        ("model://set/cup/model.sdf", b"cup"),
        ("../models/crate", b"new"),
        ("file://models/crate/new.sdf", b"new"),
        ("models/set/cup/model.sdf", b"cup"),
        ("file://crate", b"new"),
    ],
)
def test_names_lead_to_files(files: tuple[Files, str], uri: str, content: bytes) -> None:
    searched, root = files
    path = model_file(searched, searched.find(uri, f"{root}shop/worlds/a.sdf"))
    assert searched.read(path) == content


@pytest.mark.parametrize(
    "uri",
    [
        "../../../secret",
        "file://../../../secret",
        "file://ghost/a.sdf",
        "model://ghost/a.sdf",
        "model://crate/../../../../secret",
        "https://a.org/b.sdf",
    ],
)
def test_nothing_else_is_read(files: tuple[Files, str], uri: str) -> None:
    searched, root = files
    found = None
    try:
        found = searched.read(searched.find(uri, f"{root}shop/worlds/a.sdf"))
    except PackageError as error:
        assert str(error)  # noqa: PT017 - some are refused, some lead to nothing
    assert found is None


def test_a_document_alone_has_no_files() -> None:
    with pytest.raises(PackageError, match=r"only a\.sdf was given"):
        NoFiles().find("model://crate", "a.sdf")
    assert NoFiles().read("a.sdf") is None
