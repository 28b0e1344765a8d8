"""The engine's wheel: what it says of itself, what it holds, and that it runs alone on each Python found."""

from __future__ import annotations

import gzip
import json
import tomllib
import zipfile
from email import message_from_bytes
from pathlib import Path

import pytest
from setuptools import find_packages

from tests.budget import count
from tests.tools.version import version
from tests.tree_gardener.distribution import (
    CORPUS,
    ROOT,
    VERSIONS,
    build_wheel,
    interpreters,
    make_environment,
    run_corpus,
)

MOST = count("engine_wheel_cases")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_wheel(tmp_path_factory.mktemp("wheel"))


def cases(path: Path) -> int:
    raw = path.read_bytes()
    text = (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode()
    return len(json.loads(text)) if path.suffix == ".json" else len(text.splitlines())


def test_it_requires_two_packages_and_any_python_from_3_10(wheel):
    assert wheel.name == f"tree_gardener-{version()}-py3-none-any.whl"
    with zipfile.ZipFile(wheel) as opened:
        about = message_from_bytes(opened.read(f"tree_gardener-{version()}.dist-info/METADATA"))
    required = [line.partition(";") for line in about.get_all("Requires-Dist", [])]
    assert sorted(line.split("<")[0].split(">")[0] for line, _, extra in required if not extra) == [
        "lxml",
        "py-trees",
    ]
    assert about["Requires-Python"] == ">=3.10"
    assert set(about.get_all("Provides-Extra", [])) == {"groot", "ros"}
    assert f"Programming Language :: Python :: {VERSIONS[-1]}" in about.get_all("Classifier", [])


def test_it_holds_the_sources_of_the_engine_and_nothing_else(wheel):
    sources = {
        str(path.relative_to(ROOT))
        for path in (ROOT / "tree_gardener").rglob("*")
        if path.suffix in (".py", ".json", ".typed")
    }
    with zipfile.ZipFile(wheel) as opened:
        held = set(opened.namelist())
    about = {path for path in held if path.startswith(f"tree_gardener-{version()}.dist-info/")}
    assert held - about == sources
    assert f"tree_gardener-{version()}.dist-info/licenses/LICENSE" in about


def test_bt_studio_requires_it_and_does_not_hold_it():
    table = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert f"tree-gardener=={version()}" in table["project"]["dependencies"]
    packages = find_packages(str(ROOT), include=table["tool"]["setuptools"]["packages"]["find"]["include"])
    assert {name.partition(".")[0] for name in packages} == {"backend", "executor", "translator"}


@pytest.mark.parametrize("image", ["web", "executor"])
def test_images_install_it_from_the_clone(image):
    text = (ROOT / "docker" / f"{image}.Dockerfile").read_text()
    engine, _, last = text.partition("FROM tools AS engine\n")[2].partition("\nFROM ")
    assert "COPY tree_gardener tree_gardener\n" in engine
    assert "--no-deps --no-build-isolation" in engine
    assert "COPY --from=engine /build/engine/ ./\n" in last
    assert "COPY tree_gardener" not in last


@pytest.mark.parametrize("python", interpreters().items(), ids=lambda item: item[0])
def test_the_corpus_passes_on_it_with_nothing_else_installed(python, wheel, tmp_path):
    version_of_python, path = python
    own = make_environment(path, tmp_path / "env", wheel)
    found = run_corpus(own, tmp_path, most=MOST)
    assert found["python"] == version_of_python
    assert Path(found["engine"]).is_relative_to(tmp_path / "env")
    assert found["failed"] == []
    assert found["foreign"] == []
    assert found["counts"] == {file.name: min(MOST, cases(file)) for file in CORPUS}
    assert len(CORPUS) >= 13
