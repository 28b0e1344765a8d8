"""Packages started by the real `launch`, of which there are no wheels.

    BT_STUDIO_LAUNCH_SOURCES=FOLDER python -m pytest tests/ros_launch

FOLDER holds checkouts of `launch`, `launch_ros` (branch `jazzy`) and `osrf_pycommon`, under these names.
Without the variable the report says that this part did not run; with a folder that lacks one, it fails.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.translator.conftest import example_files
from tests.translator.package.patrol import patrol, write
from tests.translator.package.test_colcon import environment
from translator import load, to_ros2_package

VARIABLE = "BT_STUDIO_LAUNCH_SOURCES"
PACKAGES = (
    "launch/launch",
    "launch/launch_xml",
    "launch/launch_yaml",
    "launch_ros/launch_ros",
    "osrf_pycommon",
)
GIVEN = os.environ.get(VARIABLE, "")
collect_ignore = [] if GIVEN else ["test_reading.py", "test_real_launch.py"]

EXAMPLE = "laser_bump_and_go"
# launch_ros names it for the containers of composed nodes, which no package of ours has.
COMPOSITION = "class LoadNode:\n    class Request: ...\n    class Response: ...\n"


def sources() -> dict[str, Path]:
    """The folders of the packages, by name."""
    folders = {Path(part).name: Path(GIVEN).absolute() / part for part in PACKAGES}
    missing = [str(folder) for folder in folders.values() if not (folder / "package.xml").is_file()]
    if missing:
        pytest.fail(f"{VARIABLE}={GIVEN} lacks {', '.join(missing)}", pytrace=False)
    return folders


@pytest.fixture(scope="session")
def workspace(tmp_path_factory):
    """A workspace with `launch`, `launch_ros`, and packages of ours, built."""
    folder = tmp_path_factory.mktemp("workspace")
    for name, source in sources().items():
        shutil.copytree(source, folder / "src" / name)
    for package in (patrol(), to_ros2_package(load(example_files(EXAMPLE)))):
        write(package, folder / "src")
    services = folder / "placeholder" / "composition_interfaces" / "srv"
    services.mkdir(parents=True)
    (services.parent / "__init__.py").touch()
    (services / "__init__.py").write_text(COMPOSITION)
    done = subprocess.run(
        ["colcon", "build"], cwd=folder, env=environment(folder), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def of_launch(workspace: Path) -> dict[str, str]:
    """Returns the environment of a program that imports `launch`, which leaves temporary files."""
    files = workspace / "temporary"
    files.mkdir(exist_ok=True)
    return {
        **environment(workspace),
        "PYTHONPATH": str(workspace / "placeholder"),
        "TMPDIR": str(files),
    }


def pytest_terminal_summary(terminalreporter):
    """Says so at the end, where it is seen."""
    if not GIVEN:
        terminalreporter.write_line(
            f"tests/ros_launch was NOT run: {VARIABLE} names no checkouts.", yellow=True
        )
