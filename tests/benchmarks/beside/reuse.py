"""Takes over from this tree what another tree's set-up would make equally, as hard links.

Each set-up knows the inputs of its steps. Where they are equal in both trees and this tree's result is
current, the result is linked and the step's stamp is written, so that the other tree's own set-up passes over
it. A set-up that cannot be read so is simply run from the beginning.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

PROGRAM: Final = Path("backend", "setup", "__main__.py")
VENV: Final = ".venv"
INTERFACES: Final = Path(VENV, "share", "bt_studio_interfaces")
STEPS: Final = (
    *("python_step", "own_package_step", "node_step", "front_end_step"),
    *("interfaces_step", "ram_client_step"),
)
# The folder that a step makes. It is reused if all steps are equal that stand here.
FOLDERS: Final = {
    VENV: ("python", "packages-test"),
    "frontend/node_modules": ("npm",),
    "frontend/dist": ("front-end",),
    "tests/ram_client/node_modules": ("ram-client",),
}
# Caches, which are rewritten in place: a link would share them.
LEFT_OUT: Final = {".vite", ".vite-temp", ".cache", ".tmp"}


def reuse(ours: Path, other: Path) -> list[str]:
    """Links what is equal and missing; returns the folders that were linked."""
    try:
        here, there = SetUp(ours), SetUp(other)
    except (OSError, AttributeError, TypeError, SyntaxError, ImportError):
        return []
    equal = {name for name in there.steps if name in here.steps and here.inputs(name) == there.inputs(name)}
    equal = {name for name in equal if here.is_current(name)}
    linked = []
    for folder, needed in FOLDERS.items():
        if (other / folder).exists() or not (ours / folder).is_dir() or not equal.issuperset(needed):
            continue
        # Beside the tree, since a part that an interrupt leaves would be a change in it.
        part = other.with_name("part")
        link_tree(ours / folder, other / folder, part, rewritten=(str(ours), str(other)))
        linked.append(folder)
        for name in needed:
            there.stamp(name)
    if VENV in linked:
        if "bt-studio" in equal:
            there.stamp("bt-studio")
        if "interfaces" in equal:
            there.stamp("interfaces")
        else:
            shutil.rmtree(other / INTERFACES, ignore_errors=True)
    return linked


class SetUp:
    """The steps of a tree's own set-up, by name."""

    def __init__(self, root: Path) -> None:
        name = f"set_up_of_{abs(hash(root))}"
        spec = importlib.util.spec_from_file_location(name, root / PROGRAM)
        if spec is None or spec.loader is None:
            raise ImportError(str(root))
        self._module: Any = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self._module)
        self._root = root
        found = [self._module.packages_step("test"), *(getattr(self._module, step)() for step in STEPS)]
        self.steps: dict[str, Any] = {step.name: step for step in found}
        self._sources = {step.name: list(step.sources) for step in found}

    def inputs(self, name: str) -> list[tuple[str, bytes]]:
        """Returns the files that a step reads, by their paths in the tree."""
        files = (path for path in self._sources[name] if path.is_file())
        return sorted((str(path.relative_to(self._root)), path.read_bytes()) for path in files)

    def is_current(self, name: str) -> bool:
        """Returns whether the result of a step was made from its present inputs."""
        stamp = self._module.stamp_file(name)
        return (
            self.steps[name].product.exists() and stamp.exists() and stamp.read_text() == self._digest(name)
        )

    def stamp(self, name: str) -> None:
        """Records that the result of a step is current."""
        stamp = self._module.stamp_file(name)
        stamp.parent.mkdir(parents=True, exist_ok=True)
        stamp.write_text(self._digest(name))

    def _digest(self, name: str) -> str:
        return str(self._module.digest_of(self._sources[name]))


def link_tree(source: Path, target: Path, part: Path, *, rewritten: tuple[str, str]) -> None:
    """Copies a folder by hard links, whole or not at all; files that name the old root get the new one."""
    shutil.rmtree(part, ignore_errors=True)
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copytree(
        source, part, symlinks=True, copy_function=link_or_copy, ignore=lambda _, names: LEFT_OUT & {*names}
    )
    old, new = (text.encode() for text in rewritten)
    for path in placed_files(part):
        content = path.read_bytes()
        if old in content:
            mode = path.stat().st_mode
            path.unlink()
            path.write_bytes(content.replace(old, new))
            path.chmod(mode)
    part.rename(target)


def placed_files(environment: Path) -> Iterator[Path]:
    """Returns the files of a virtual environment that may name the folder it is in."""
    yield from environment.glob("pyvenv.cfg")
    yield from environment.glob("lib/*/site-packages/*.pth")
    yield from environment.glob("lib/*/site-packages/*.dist-info/direct_url.json")
    for path in environment.glob("bin/*"):
        if path.is_file() and not path.is_symlink() and b"\0" not in path.read_bytes()[:1024]:
            yield path


def link_or_copy(source: str, target: str) -> None:
    """Links a file, or copies it where the file system has no hard links."""
    try:
        os.link(source, target, follow_symlinks=False)
    except OSError:
        shutil.copy2(source, target, follow_symlinks=False)
