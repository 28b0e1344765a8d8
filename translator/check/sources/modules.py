"""Which modules exist, and which names they have, found by their files; no module is imported.

A web server of a team has other packages than the sessions that run projects. There only what no list names
is reported, and only as a warning.
"""

from __future__ import annotations

import ast
import importlib.util
import re
import sys
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Final

from translator.python_source import parse
from translator.ros_interfaces import has_package

if TYPE_CHECKING:
    from collections.abc import Mapping

ACTIONS: Final = "actions"
OURS: Final = frozenset({"tree_gardener", "tree_tools", "cv_bridge", ACTIONS})
_OF_SESSIONS: Final = frozenset(
    {"em", "glcontext", "lark", "moderngl", "pybullet", "pybullet_data", "pybullet_utils"}
)
"""Packages of the executor's image that neither the web server's nor rosdep's list has."""
_BESIDE: Final = Path(__file__).parents[3] / "executor" / "ros_python"
_MOST_BYTES: Final = 512 * 1024
_MOST_MODULES: Final = 300
_MOST_KEPT: Final = 2000
_here: Final[dict[str, Module]] = {}
_REQUIREMENT: Final = re.compile(r"^\s*([A-Za-z0-9][\w.-]*)", re.MULTILINE)
_DEPEND: Final = re.compile(r"<(?:\w+_)?depend\b[^>]*>\s*([\w-]+)")
_DYNAMIC: Final = frozenset({"globals", "exec", "vars", "locals", "__getattr__", "__path__"})
"""Names of a module that may make further ones while it runs."""


@dataclass(frozen=True)
class Names:
    """The names of a module.

    Attributes:
        names: what it binds.
        enums: the members of its enumerations, by class.
    """

    names: frozenset[str]
    enums: Mapping[str, frozenset[str]]


@dataclass(frozen=True)
class Module:
    """A module that was found.

    Attributes:
        path: its file; None if it has none that can be read.
        folder: the folder of a package.
        source: the text of a module of the project.
    """

    path: Path | None = None
    folder: Path | None = None
    source: str | None = None

    @property
    def names(self) -> Names | None:
        """The names of the module; None if they cannot be known without running it."""
        if self.source is not None:
            return _names(self.source)
        return None if self.path is None or self.path.suffix != ".py" else _names_in(self.path)

    def has_child(self, name: str) -> bool:
        """Returns whether the package may have a module of this name."""
        if self.folder is None:
            return False
        ends = (".py", ".pyc", *EXTENSION_SUFFIXES)
        return (self.folder / name).is_dir() or any((self.folder / f"{name}{end}").is_file() for end in ends)

    def child(self, name: str) -> Module | None:
        """Returns a module of the package, or None."""
        if self.folder is None or not self.has_child(name):
            return None
        return _at(self.folder / name)


class Modules:
    """The modules that a project can import.

    Args:
        files: the files of the project, by path; empty for a single source.
    """

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files
        self._found: dict[str, Module | None] = {}

    @cached_property
    def actions(self) -> Mapping[str, bytes]:
        """The sources in `actions/`, by the name of the module."""
        return {
            PurePosixPath(path).stem: data
            for path, data in self._files.items()
            if path.endswith(".py") and PurePosixPath(path).parent.as_posix() == ACTIONS
        }

    @cached_property
    def _own(self) -> frozenset[str]:
        """Names that the folder of the project and its `actions/` give."""
        found = set(self.actions)
        for path in self._files:
            parts = PurePosixPath(path).parts
            if path.endswith((".py", ".so")):
                found.add(parts[0].partition(".")[0])
                if parts[0] == ACTIONS and len(parts) > 2:
                    found.add(parts[1])
        return frozenset(found)

    @cached_property
    def has_requirements(self) -> bool:
        """Whether the project lists packages to install, whose imports may have other names."""
        return "requirements.txt" in self._files

    @cached_property
    def _listed(self) -> frozenset[str]:
        text = self._files.get("requirements.txt", b"").decode("utf-8", "replace")
        found = {_normal(name) for name in _REQUIREMENT.findall(text)}
        for path, data in self._files.items():
            if PurePosixPath(path).name == "package.xml":
                found.update(map(_normal, _DEPEND.findall(data.decode("utf-8", "replace"))))
        return frozenset(found)

    def has_action(self, name: str) -> bool:
        """Returns whether `actions/` has a module or a package of this name."""
        return name in self.actions or any(path.startswith(f"{ACTIONS}/{name}/") for path in self._files)

    def is_own(self, top: str) -> bool:
        """Returns whether a name is that of a module of the project or of the studio."""
        return top in OURS or top in self._own

    def is_listed(self, module: str) -> bool:
        """Returns whether the target has the module although this environment may not."""
        from translator.package.rosdep import rosdep_table  # noqa: PLC0415 - a large table

        top = module.partition(".")[0]
        return (
            top in _OF_SESSIONS
            or _normal(top) in self._listed
            or has_package(top)
            or rosdep_table().key_of(module) is not None
        )

    def find(self, dotted: str) -> Module | None:
        """Returns the module of a full name, or None if it is not here or has no file that can be read.

        Of a project that names very many modules, only the first ones are looked up.
        """
        if dotted not in self._found and len(self._found) < _MOST_MODULES:
            self._found[dotted] = self._find(dotted)
        return self._found.get(dotted)

    def _find(self, dotted: str) -> Module | None:
        top, *rest = dotted.split(".")
        if top == ACTIONS and len(rest) == 1 and rest[0] in self.actions:
            return Module(source=self.actions[rest[0]].decode("utf-8", "replace"))
        is_both = top in self._own and is_installed(top)
        if not rest and top in self.actions and not is_both:
            return Module(source=self.actions[top].decode("utf-8", "replace"))
        if top in self._own or top in OURS - {"tree_gardener"}:
            return None
        found = installed(top)
        for name in rest:
            found = found.child(name) if found is not None else None
        return found


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


@cache
def runs_projects() -> bool:
    """Returns whether this environment is one in which projects run."""
    return is_installed("rclpy")


def is_installed(top: str) -> bool:
    """Returns whether Python finds a module of this name, without a dot, here."""
    return top in sys.stdlib_module_names or installed(top) is not None


def installed(top: str) -> Module | None:
    """Returns an installed module, or None; what was found once is not looked for again."""
    if top not in _here and (found := _look(top)) is not None:
        _here[top] = found
        if len(_here) > _MOST_KEPT:
            del _here[next(iter(_here))]
    return _here.get(top)


def _look(top: str) -> Module | None:
    if (_BESIDE / top).is_dir():
        return _at(_BESIDE / top)
    try:
        spec = importlib.util.find_spec(top)
    except (ImportError, ValueError, AttributeError):
        return Module() if top in sys.modules else None
    if spec is None:
        return None
    if not spec.has_location or not spec.origin:
        return Module()
    path = Path(spec.origin)
    return Module(path, path.parent if path.name == "__init__.py" else None)


def _at(path: Path) -> Module:
    if path.is_dir():
        index = path / "__init__.py"
        return Module(index if index.is_file() else None, path)
    file = path.with_name(f"{path.name}.py")
    return Module(file if file.is_file() else None)


@lru_cache(maxsize=512)
def _names_in(path: Path) -> Names | None:
    try:
        if path.stat().st_size > _MOST_BYTES:
            return None
        return _names(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        return None


@lru_cache(maxsize=256)
def _names(source: str) -> Names | None:
    try:
        module = parse(source, "<module>")
        return _names_of(module)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _names_of(module: ast.Module) -> Names | None:
    found = {
        "__name__",
        "__doc__",
        "__file__",
        "__package__",
        "__spec__",
        "__loader__",
        "__dict__",
        "__path__",
    }
    for node in ast.walk(module):
        if isinstance(node, ast.Import | ast.ImportFrom):
            found.update(alias.asname or alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.Name):
            if isinstance(node.ctx, ast.Store):
                found.add(node.id)
            elif node.id in _DYNAMIC:
                return None
        elif isinstance(node, ast.Attribute) and node.attr == "modules":
            return None
        elif isinstance(name := getattr(node, "name", None), str):
            found.add(name)
    if "*" in found or not _DYNAMIC.isdisjoint(found - {"__path__"}):
        return None
    return Names(frozenset(found), _enums(module))


def _enums(module: ast.Module) -> dict[str, frozenset[str]]:
    """Returns what the plain enumerations of a module hold, by their names."""
    return {
        cls.name: frozenset(
            getattr(node, "id", "") or getattr(node, "name", "")
            for node in ast.walk(cls)
            if isinstance(node, ast.Name | ast.FunctionDef)
        )
        for cls in module.body
        if isinstance(cls, ast.ClassDef) and [ast.unparse(base) for base in cls.bases] == ["enum.Enum"]
    }
