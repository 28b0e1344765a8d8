"""Writes the version of `pyproject.toml` to its copies: `python -m tests.tools.version`.

Images run from source and are not installed, so that `importlib.metadata` knows no version there.
The engine is a distribution with the same version: `bt-studio` requires it, and exported packages compare it.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
PYTHON: Final = re.compile(r'^(__version__ = ")[^"]*(")', re.MULTILINE)
# The first versions of these files are the page's own; those of packages follow.
NPM: Final = re.compile(r'^(  "version": ")[^"]*(")', re.MULTILINE)
NPM_ROOT: Final = re.compile(r'^(      "version": ")[^"]*(")', re.MULTILINE)
SITE: Final = re.compile(r'^(site_name = "BT Studio )[^"]*(")', re.MULTILINE)
PROJECT: Final = re.compile(r'^(version = ")[^"]*(")', re.MULTILINE)
REQUIRED: Final = re.compile(r'^(  "tree-gardener==)[^"]*(")', re.MULTILINE)
COPIES: Final[dict[str, list[re.Pattern[str]]]] = {
    "backend/__init__.py": [PYTHON],
    "executor/__init__.py": [PYTHON],
    "frontend/package.json": [NPM],
    "frontend/package-lock.json": [NPM, NPM_ROOT],
    "pyproject.toml": [REQUIRED],
    "tree_gardener/__init__.py": [PYTHON],
    "tree_gardener/pyproject.toml": [PROJECT],
    "zensical.toml": [SITE],
}


def version() -> str:
    """Returns the version of BT Studio."""
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return str(table["project"]["version"])


def copies() -> dict[Path, str]:
    """Returns the text of each file that repeats the version, by path."""
    found = {}
    for name, patterns in COPIES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        for pattern in patterns:
            text, count = pattern.subn(rf"\g<1>{version()}\g<2>", text, count=1)
            if count != 1:
                raise LookupError(f"{name} has no version")
        found[ROOT / name] = text
    return found


def main() -> None:
    """Writes the copies."""
    for path, text in copies().items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
