"""Bundles of which a worker knows the files that the translator reads, and of the others their paths."""

from __future__ import annotations

import base64
import io
import zipfile
from typing import Any

import pytest

from backend.workers.bundles import KINDS, bundle, package_preview, put, whole
from tests.backend.workers.test_jobs import FILES

OTHERS = {"assets/a.bin": bytes(5000), "assets/b.bin": b"", "robots/own/robot.yaml": b"robot"}
SIZES = {path: len(data) for path, data in OTHERS.items()}
ASKED: dict[str, dict[str, Any]] = {
    "app": {"universe": "empty", "built_in": b"name: empty\n", "revision": 3},
    "app_zip": {},
    "package": {"name": "own"},
    "cpp_package": {"name": "own"},
}


def unzipped(packed: str | bytes) -> dict[str, bytes]:
    raw = packed if isinstance(packed, bytes) else base64.b64decode(packed)
    with zipfile.ZipFile(io.BytesIO(raw)) as found:
        return {name: found.read(name) for name in found.namelist()}


@pytest.mark.parametrize("kind", KINDS)
def test_a_bundle_names_what_the_whole_one_holds(kind: str) -> None:
    expected = whole(kind)({**FILES, **OTHERS}, **ASKED[kind])
    made = bundle(dict(FILES), kind=kind, others=SIZES, **ASKED[kind])
    stored = FILES | OTHERS
    for place, listed in made["zips"].items():
        own = [held for _, held in listed if isinstance(held, bytes)]
        assert not {*own} & ({*stored.values()} - {b""})
        packed: Any = expected
        for name in place.split("/"):
            packed = packed[name]
        assert {path: stored.get(held, held) for path, held in listed} == unzipped(packed)
        put(made["values"], place, packed)
    assert made["values"] == expected


def test_a_preview_has_the_sizes_of_what_stays_behind() -> None:
    found = package_preview(dict(FILES), others=SIZES, name="own")
    packed = unzipped(whole("package")({**FILES, **OTHERS}, name="own")["zip"])
    listed = {file["path"]: file["size"] for file in found["files"]}
    assert listed == {path: len(data) for path, data in packed.items()}
