"""Builds the oracle where libsdformat is installed (Debian's `libsdformat-dev`), and asks it."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.sdf_oracle.random_worlds import CONFIG, PART

if TYPE_CHECKING:
    from collections.abc import Mapping

SOURCE: Final = Path(__file__).with_name("oracle.cpp")
LIBRARY: Final = "sdformat12"
Answer = dict[str, list[float]]
"""Poses x, y, z, qx, qy, qz, qw in the world by kind and name."""


def is_there() -> bool:
    """Returns whether the oracle can be built here."""
    tools = all(shutil.which(tool) for tool in ("g++", "pkg-config"))
    return tools and subprocess.run(["pkg-config", "--exists", LIBRARY], check=False).returncode == 0


def ask(worlds: Mapping[str, str], folder: Path) -> dict[str, Answer]:
    """Returns the poses in worlds, by their names; none for a world that libsdformat refuses."""
    program = folder / "oracle"
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", LIBRARY], check=True, capture_output=True, text=True
    ).stdout.split()
    subprocess.run(["g++", "-O1", "-std=c++17", str(SOURCE), "-o", str(program), *flags], check=True)
    part = folder / "models" / "part"
    part.mkdir(parents=True)
    (part / "model.sdf").write_text(PART)
    (part / "model.config").write_text(CONFIG)
    for name, text in worlds.items():
        (folder / name).write_text(text)
    paths = [str(folder / name) for name in worlds]
    said = subprocess.run(
        [str(program), str(folder / "models"), *paths], check=True, capture_output=True, text=True
    )
    answers: dict[str, Answer] = {}
    current: Answer = {}
    for line in said.stdout.splitlines():
        kind, name, values = line.split("\t")
        if kind == "file":
            current = answers[Path(name).name] = {}
        else:
            current[f"{kind} {name}"] = [float(value) for value in values.split()]
    return answers
