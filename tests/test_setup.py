"""Set-up on machines that lack something: it reports in one sentence what is missing, and the remedy."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from types import ModuleType

ROOT = Path(__file__).parent.parent
SCRIPT = ROOT / "backend" / "setup" / "__main__.py"


@pytest.fixture
def setup() -> ModuleType:
    spec = importlib.util.spec_from_file_location("bt_studio_setup", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def program(folder: Path, name: str, output: str) -> None:
    """Puts a program that prints `output` on the path."""
    path = folder / name
    path.write_text(f"#!/bin/sh\necho '{output}'\n")
    path.chmod(0o755)


def run_setup(path: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, str(SCRIPT.parent), "run"],
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )


def test_missing_node_is_said_with_the_remedy(tmp_path: Path) -> None:
    result = run_setup(str(tmp_path))
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1
    assert "Node.js is missing; install Node 20.19" in result.stderr


def test_an_old_node_is_said_with_its_version(tmp_path: Path) -> None:
    program(tmp_path, "node", "v18.4.0")
    program(tmp_path, "npm", "9.0.0")
    result = run_setup(str(tmp_path))
    assert result.returncode == 1
    assert "v18.4.0 is too old; install Node 20.19" in result.stderr


def test_another_python_is_said_with_the_remedy(
    setup: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(setup.sys, "version_info", (3, 12, 1))
    with pytest.raises(SystemExit) as ended:
        setup.check_machine()
    assert ended.value.code == 1
    assert "needs CPython 3.11" in capsys.readouterr().err


@pytest.mark.parametrize(("system", "machine"), [("darwin", "arm64"), ("linux", "aarch64")])
def test_another_machine_is_said_with_what_is_supported(
    setup: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    system: str,
    machine: str,
) -> None:
    monkeypatch.setattr(setup.sys, "platform", system)
    monkeypatch.setattr(setup.platform, "machine", lambda: machine)
    with pytest.raises(SystemExit):
        setup.check_machine()
    assert "Linux x86-64 with CPython 3.11" in capsys.readouterr().err


def test_a_step_is_taken_again_only_when_its_sources_change(
    setup: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(setup, "ROOT", tmp_path)
    monkeypatch.setattr(setup, "STAMPS", tmp_path / "stamps")
    source, product = tmp_path / "source", tmp_path / "product"
    source.write_text("one")
    made: list[str] = []

    def make() -> None:
        made.append(source.read_text())
        product.write_text("made")

    step = setup.Step("thing", "making the thing", [source], product, make)
    setup.take(step)
    setup.take(step)
    assert made == ["one"]
    source.write_text("two")
    setup.take(step)
    assert made == ["one", "two"]
    product.unlink()
    setup.take(step)
    assert made == ["one", "two", "two"]
