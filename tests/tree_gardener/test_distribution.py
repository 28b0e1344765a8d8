"""The engine's wheel: what it says of itself, what it holds, and that it runs alone on each Python found."""

from __future__ import annotations

import gzip
import json
import re
import subprocess
import sys
import tomllib
import zipfile
from email import message_from_bytes
from fnmatch import fnmatch
from pathlib import Path

import pytest

from tests.budget import count
from tests.tools.sources import imports_of
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

PAGE = ROOT / "docs" / "how-to" / "use-the-engine-by-itself.md"
FILE = re.compile(r"`([\w/]+\.\w+)`:\n\n```\w+\n(.*?)^```$", re.DOTALL | re.MULTILINE)
PYTHON = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)
# Those of the extra `ros`, and those that come with a ROS of the machine alone.
ROS = {"geometry_msgs", "rcl_interfaces", "rclpy"} | {
    *("ament_index_python", "btcpp_ros2_interfaces", "tf2_geometry_msgs", "tf2_msgs", "tf2_ros"),
}
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


def test_its_modules_import_what_it_and_its_extras_require():
    imports = {
        each.module.partition(".")[0]
        for path in (ROOT / "tree_gardener").rglob("*.py")
        for each in imports_of(path.read_text(encoding="utf-8"))
    }
    others = imports - sys.stdlib_module_names - {"tree_gardener"}
    assert others == {"lxml", "py_trees"} | {"msgpack", "zmq"} | ROS


def test_bt_studio_requires_it_and_does_not_hold_it():
    table = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert f"tree-gardener=={version()}" in table["project"]["dependencies"]
    held = table["tool"]["setuptools"]["packages"]["find"]["include"]
    assert not any(fnmatch("tree_gardener.script", pattern) for pattern in held)
    assert any(fnmatch("translator.package", pattern) for pattern in held)


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


@pytest.fixture
def garden(tmp_path: Path) -> Path:
    """The files of the how-to, in an empty folder."""
    files = dict(FILE.findall(PAGE.read_text()))
    assert sorted(files) == ["actions/IsMoist.py", "actions/Water.py", "test_garden.py", "tree.xml"]
    for name, text in files.items():
        (tmp_path / "garden" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "garden" / name).write_text(text)
    return tmp_path / "garden"


def said(*command: str | Path, folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_how_to_runs_on_it_as_it_is_written(wheel, garden, tmp_path):
    own = make_environment(sys.executable, tmp_path / "env", wheel)
    (garden / "tree.xml").write_text(
        (garden / "tree.xml").read_text().replace('seconds="3"', 'seconds="0.1"')
    )
    options = ("--actions", "actions", "--max-ticks")
    run: list[str | Path] = [own, "-m", "tree_gardener", "run", "tree.xml", *options]
    halted = subprocess.run([*run, "7"], cwd=garden, capture_output=True, text=True, check=False)
    assert halted.stdout.splitlines() == ["valve open", "valve closed", "the root returned RUNNING"]
    [by_hand] = [text for text in PYTHON.findall(PAGE.read_text()) if "tree.shutdown()" in text]
    assert "valve open" in said(own, "-c", by_hand.replace("100", "8"), folder=garden)
    [hello] = PYTHON.findall((ROOT / "tree_gardener" / "README.md").read_text())
    assert said(own, "-I", "-c", hello, folder=garden).splitlines() == [
        "Hello, world",
        "Hello, robot",
        "Status.SUCCESS",
    ]


def test_its_behaviour_test_passes_and_would_not(garden):
    settings = garden / "pytest.ini"
    settings.write_text("[pytest]\n")
    alone = ["-p", "no:cacheprovider", "--disable-plugin-autoload"]
    run = [sys.executable, "-m", "pytest", "-q", "-c", settings, *alone, "test_garden.py"]
    assert "2 passed" in said(*run, folder=garden)
    tree = (garden / "tree.xml").read_text()
    (garden / "tree.xml").write_text(tree.replace("Fallback", "Sequence"))
    broken = subprocess.run(run, cwd=garden, capture_output=True, text=True, check=False)
    assert broken.returncode == 1
    assert "wanted" in broken.stdout
