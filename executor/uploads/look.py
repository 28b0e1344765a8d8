"""Lists what an upload holds: robots, worlds and maps. Nothing of it is executed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.imports.maps import is_map
from executor.robots.importing.bring import folder_name
from executor.robots.importing.candidates import arguments_of, read_start, robots_in

if TYPE_CHECKING:
    from pathlib import Path

MOST_ITEMS: Final = 500
_WORLDS: Final = (".sdf", ".world")
_MAPS: Final = (".yaml", ".yml")
_MOST_MAP_BYTES: Final = 20_000


def items(root: Path) -> list[dict[str, Any]]:
    """Returns the robots, worlds and maps in a folder.

    Those that nothing else includes come first, and of them maps, which lie beside robots, last.
    """
    found = [*_robots(root), *_universes(root)]
    found.sort(
        key=lambda item: (
            not item["is_main"], item["source"] == "map", item["path"].count("/"), item["path"]
        )
    )  # fmt: skip
    return found[:MOST_ITEMS]


def name_of(path: Path, root: Path) -> str:
    """Returns the name that is proposed for the robot or universe of a file."""
    return "imported" if path.parent == root and path.stem in ("model", "world") else folder_name(path)


def _robots(root: Path) -> list[dict[str, Any]]:
    made = []
    for path, is_main in robots_in(root).items():
        text = read_start(path)
        kind = "sdf" if path.suffix == ".sdf" else "urdf"
        if kind == "urdf" and (path.suffix == ".xacro" or "<xacro:" in text or "${" in text or "$(" in text):
            kind = "xacro"
        arguments = arguments_of(text) if kind == "xacro" else {}
        made.append(_item("robot", kind, path, root, is_main=is_main, arguments=arguments))
    return made


def _universes(root: Path) -> list[dict[str, Any]]:
    made = []
    for path in sorted(root.rglob("*")):
        if not path.is_file() or path.is_symlink():
            continue
        if path.suffix in _WORLDS and "<world" in read_start(path):
            made.append(_item("universe", "sdf", path, root))
        elif path.suffix in _MAPS and path.stat().st_size < _MOST_MAP_BYTES:
            text = path.read_text(encoding="utf-8", errors="replace")
            if "resolution" in text and is_map(text):
                made.append(_item("universe", "map", path, root))
    return made


def _item(  # noqa: PLR0913 - one a field
    kind: str,
    source: str,
    path: Path,
    root: Path,
    *,
    is_main: bool = True,
    arguments: dict[str, str | None] | None = None,
) -> dict[str, Any]:
    return {
        "kind": kind,
        "source": source,
        "path": path.relative_to(root).as_posix(),
        "name": name_of(path, root),
        "is_main": is_main,
        "arguments": [{"name": name, "default": value} for name, value in (arguments or {}).items()],
    }
