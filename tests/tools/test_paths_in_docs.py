"""Pages of the documentation name modules that exist; after a move, the page is changed with the module."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path, PurePosixPath
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
CODE: Final = re.compile(r"```.*?```", re.DOTALL)
SPAN: Final = re.compile(r"`([^`\s]+)`")
MODULE: Final = re.compile(r"[\w.-]+(?:/[\w.-]+)*\.(?:py|tsx?)")
# The first words of paths that can be nothing else, with or without the ending of a file.
TOPS: Final = (
    "backend/",
    "executor/",
    "translator/",
    "tree_gardener/",
    "frontend/src/",
    "store/",
    "features/",
)
# Files of a project, or of a package that we export.
OF_USERS: Final = re.compile(
    r"\.launch\.py$|^(?:actions|launch|evaluations|assets)/|^(?:judge|execute_docker|test_garden)\.py$"
)


def tracked() -> set[str]:
    """Returns every end of the path of each file and folder: with its ending, and without."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    paths = {PurePosixPath(name) for name in listed.stdout.splitlines()}
    paths |= {parent for path in paths for parent in path.parents}
    paths |= {path.with_suffix("") for path in paths if path.name}
    return {"/".join(path.parts[first:]) for path in paths for first in range(len(path.parts))}


def missing(text: str, known: set[str]) -> list[str]:
    """Returns the modules that a page names and that do not exist."""
    names = (name.rstrip("/").partition("::")[0] for name in SPAN.findall(CODE.sub("", text)))
    named = [name for name in names if re.fullmatch(r"[\w./-]+", name) and not OF_USERS.search(name)]
    return [name for name in named if (MODULE.fullmatch(name) or name.startswith(TOPS)) and name not in known]


def test_the_pages_name_modules_that_exist():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    known = tracked()
    found = {
        str(page.relative_to(ROOT)): names
        for page in pages
        if (names := missing(page.read_text(encoding="utf-8"), known))
    }
    assert found == {}


def test_a_moved_module_is_found():
    known = tracked()
    text = "`tests/tools/words.py`, `tools/words.py::main`, `store/project/gone.ts`"
    assert missing(text + "\n```\n`executor/gone.py`\n```\n`executor/world/gone`", known) == [
        "store/project/gone.ts",
        "executor/world/gone",
    ]
    assert missing("`actions/Turn.py` and `launch/robot.launch.py` are files of a project", known) == []
