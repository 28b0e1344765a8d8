"""The modules of a tree, taken apart; what was seen once is kept in `var`, by the digest of its text."""

from __future__ import annotations

import contextlib
import pickle
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.selection import units
from tests.tools.selection.table import ROOT
from tests.tools.selection.tree import blob
from tests.tools.selection.units import Module, module_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

CACHE: Final = ROOT / "var" / "units.pickle"
# Another version of Python or of the rules has other syntax trees.
_VERSION: Final = (sys.version, Path(units.__file__).read_bytes())


def modules(tree: Mapping[str, str], paths: Iterable[str], root: Path = ROOT) -> dict[str, Module]:
    """Returns modules of the working tree by their paths."""
    known = _cached()
    found: dict[str, Module] = {}
    fresh: dict[str, Module] = {}
    for path in paths:
        module = known.get(tree[path])
        if module is None:
            content = (root / path).read_bytes() if (root / path).exists() else b""
            module = module_of(content)
            if blob(content) == tree[path]:  # it was not changed meanwhile
                fresh[tree[path]] = module
        found[path] = module
    if fresh:
        _keep({tree[path]: found[path] for path in found if tree[path] in known} | fresh)
    return found


def of_commit(root: Path, commit: str, path: str) -> Module:
    """Returns a module as a commit has it; one without units where it has none."""
    shown = subprocess.run(["git", "show", f"{commit}:{path}"], cwd=root, check=False, capture_output=True)
    return module_of(shown.stdout if shown.returncode == 0 else b"")


def _cached() -> dict[str, Module]:
    try:
        version, known = pickle.loads(CACHE.read_bytes())  # noqa: S301 - our own file
        return known if version == _VERSION else {}
    except Exception:  # a file that is missing, or of another version
        return {}


def _keep(known: dict[str, Module]) -> None:
    new = CACHE.with_suffix(".new")
    with contextlib.suppress(OSError):  # it is only faster with it
        CACHE.parent.mkdir(exist_ok=True)
        new.write_bytes(pickle.dumps((_VERSION, known)))
        new.replace(CACHE)
