"""The Python that an export adds passes ament's linters, by the rules of ruff that are the same.

`ament_flake8` is flake8 with its settings below, and the plugins for builtins, comprehensions, docstrings,
order of imports and quotes. `ament_pep257` is pydocstyle with the same list of ignored rules.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.translator.conftest import ACTION, diagram_bytes
from translator import load, to_app_zip, to_ros2_package
from translator.archive import read_zip
from translator.package.ros2 import templates_folder

CONFIG = """
line-length = 99
preview = true
target-version = "py312"
[lint]
select = ["A", "BLE", "C4", "C90", "D", "E", "F", "I", "Q", "W"]
ignore = ["D100", "D101", "D102", "D103", "D104", "D105", "D106", "D107", "D203", "D212", "D404"]
explicit-preview-rules = false
[lint.flake8-quotes]
inline-quotes = "single"
[lint.isort]
case-sensitive = false
force-sort-within-sections = true
order-by-type = false
[lint.mccabe]
max-complexity = 30
"""
LONG = 'It\'s long, and has "quotes": ' + "word after word, " * 30 + "x" * 150


def linted(files: dict[str, bytes], folder: Path) -> str:
    for path, raw in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(raw)
    (folder / "ruff.toml").write_text(CONFIG)
    ruff = Path(sys.executable).with_name("ruff")
    done = subprocess.run(
        [ruff, "check", "--no-cache", "--config", folder / "ruff.toml", folder],
        capture_output=True,
        text=True,
        check=False,
    )
    return "" if done.returncode == 0 else done.stdout + done.stderr


def generated(files: dict[str, bytes]) -> dict[str, bytes]:
    """The Python of a package that is neither the user's nor the engine's."""
    names = {"setup.py", "main.py", "test_behaviours.py", "execute_docker.py"}
    return {
        path: raw
        for path, raw in files.items()
        if path.rpartition("/")[2] in names or path.endswith("test_bt.launch.py")
    }


def project(**settings: object):
    files = {
        "trees/MainTree.json": diagram_bytes({"n1": {"type": "Act"}}),
        "actions/Act.py": ACTION.format(name="Act").encode(),
        "tests/all.test.yaml": b"format: bt-studio/tests\nversion: 1\ntests: []\n",
    }
    for number in range(12):
        folder = f"deep_folder_{number}"
        files[f"actions/{folder}/module.py"] = b""
        files[f"assets/{folder}/a_picture_with_a_rather_long_name_{number}.png"] = b""
        files[f"launch/program_{number}.py"] = b"#!/usr/bin/env python3\n"
        files[f"launch/number_{number}.launch.py"] = b"def generate_launch_description():\n    pass\n"
    document = {"format": "bt-studio/project", "version": 1, "name": "Test", **settings}
    return load({**files, "project.json": json.dumps(document).encode()})


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {
            "description": LONG,
            "license": "Some licence of our own, " * 4,
            "maintainer": {"name": "Anna-Maria " * 10, "email": "a" * 120 + "@example.org"},
        },
    ],
)
def test_the_generated_python_of_a_package(settings: dict[str, object], tmp_path: Path) -> None:
    package = to_ros2_package(project(**settings), name="test_bt")
    files = generated(dict(package.files))
    assert len(files) == 5
    assert linted(files, tmp_path) == ""
    setup = files["test_bt/setup.py"].decode()
    seen: dict[str, object] = {}
    exec(setup.replace("from setuptools import setup", "setup = lambda **k: seen.update(k)"), {"seen": seen})  # noqa: S102
    if settings:
        assert seen["description"] == " ".join(LONG.split())
        assert seen["maintainer"] == "Anna-Maria " * 10
    assert len(dict(seen["data_files"])) > 12  # type: ignore[call-overload]


def test_without_launch_files_and_tests(example, tmp_path: Path) -> None:
    package = to_ros2_package(example, name="test_bt")
    assert linted(generated(dict(package.files)), tmp_path) == ""


def test_the_program_of_an_app(tmp_path: Path) -> None:
    files = generated(read_zip(to_app_zip(project())))
    assert "execute_docker.py" in files
    assert linted({"execute_docker.py": files["execute_docker.py"]}, tmp_path) == ""


def test_every_template_of_python_is_linted() -> None:
    found = {path.name for path in Path(templates_folder()).glob("*.py.j2")}
    assert found == {
        "engine_setup.py.j2",
        "execute_docker.py.j2",
        "launch.py.j2",
        "main.py.j2",
        "setup.py.j2",
        "test_behaviours.py.j2",
    }
