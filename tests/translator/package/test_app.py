"""The app for the manager."""

from __future__ import annotations

import io
import json
import zipfile

import pytest

from translator import TranslatorError, load, self_contained, to_app_zip
from translator.package.app import app_files, files_beside_engine
from translator.package.engine import engine_files


def unzipped(raw):
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_app_holds_all_that_runs(example):
    files = unzipped(to_app_zip(example))
    assert files["self_contained_tree.xml"].decode() == self_contained(example)
    assert json.loads(files["project.json"]) == example.settings.to_json()
    assert {f"actions/{name}.py" for name in example.actions} <= set(files)
    assert "tree_gardener/__init__.py" in files
    assert {name for name in example.files if name.startswith("trees/")} <= set(files)
    assert "tree_gardener/catalog.json" in files
    compile(files["execute_docker.py"], "execute_docker.py", "exec")


def test_the_app_is_the_engine_and_the_files_beside_it(example):
    beside = files_beside_engine(example)
    assert not [name for name in beside if name.startswith("tree_gardener/")]
    assert app_files(example) == {**beside, **engine_files()}
    assert {f"actions/{name}.py" for name in example.actions} <= set(beside)


def test_assets_and_launch_files_travel_along(make_project):
    project = make_project(
        {"n1": {"type": "Act"}},
        files={"assets/a.bin": b"a", "launch/b.launch.py": b"b", "nodes/c.py": b"c", "x": b"x"},
    )
    files = unzipped(to_app_zip(project))
    assert files["assets/a.bin"] == b"a"
    assert files["launch/b.launch.py"] == b"b"
    assert files["nodes/c.py"] == b"c"
    assert "x" not in files


def test_same_input_gives_the_same_bytes(example):
    assert to_app_zip(example) == to_app_zip(load(example.files))


def test_errors_are_refused(make_project):
    with pytest.raises(TranslatorError):
        to_app_zip(make_project({}))
