"""Declared Python dependencies, and the place where each is used."""

from __future__ import annotations

import functools
import json
import re
import tomllib
from importlib import metadata
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.sources import imports_of

if TYPE_CHECKING:
    from collections.abc import Mapping

ROOT: Final = Path(__file__).resolve().parents[2]
PRODUCT: Final = ("backend", "executor", "translator", "tree_gardener")
SOURCES: Final = (*PRODUCT, "tests", "docker")
# Packages that no source imports, each with a file and the text in it that uses the package.
USED_BY: Final[dict[str, tuple[str, str]]] = {
    "channels-redis": ("backend/config/settings.py", "channels_redis.pubsub"),
    "colcon-bash": ("tests/translator/package/test_colcon.py", "setup.bash"),
    "colcon-core": ("tests/translator/package/test_colcon.py", "colcon"),
    "colcon-python-setup-py": ("translator/package/templates/setup.py.j2", "setup("),
    "colcon-ros": ("translator/package/templates/package.xml.j2", "ament_python"),
    "cyclonedx-bom": ("tests/tools/sbom.py", "cyclonedx-py"),
    "django-stubs": ("pyproject.toml", "mypy_django_plugin"),
    "djangorestframework-stubs": ("backend/core/problems.py", "rest_framework"),
    "drf-spectacular-sidecar": ("backend/config/settings.py", "drf_spectacular_sidecar"),
    "flask": ("tests/backend/bucket.py", "moto.server"),
    "flask-cors": ("tests/backend/bucket.py", "moto.server"),
    "httptools": ("backend/core/heads.py", "httptools_impl"),
    "import-linter": ("Makefile", "lint-imports"),
    "lxml-stubs": ("executor/robots/urdf.py", "lxml"),
    "moto": ("tests/backend/bucket.py", "moto.server"),
    "mypy": ("Makefile", "$(BIN)/mypy"),
    "ty": ("backend/language/servers.py", 'with_name("ty")'),
    "pytest-asyncio": ("pyproject.toml", "asyncio_mode"),
    "pytest-django": ("pyproject.toml", "DJANGO_SETTINGS_MODULE"),
    "pytest-timeout": ("pyproject.toml", "timeout = "),
    "redis": ("backend/config/settings.py", "redis.RedisCache"),
    "ros-jazzy-common-interfaces": ("executor/ros/messages.py", "from nav_msgs"),
    "ros-jazzy-rclpy": ("tree_gardener/ros.py", "rclpy"),
    "ruff": ("Makefile", "$(BIN)/ruff"),
    "types-psutil": ("executor/supervision/processes.py", "import psutil"),
    "types-pyyaml": ("executor/universes/document.py", "yaml"),
    "zensical": ("Makefile", "bin/zensical build"),
}


def declared() -> list[str]:
    """Returns the normalised names of all declared packages."""
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return _names([*table["project"]["dependencies"], *chain(*table["dependency-groups"].values())])


def shipped() -> list[str]:
    """Returns the normalised names of the packages that users install."""
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return _names(table["project"]["dependencies"])


def of_the_page() -> list[str]:
    """Returns the names of the packages that the page and its build declare."""
    table = json.loads((ROOT / "frontend" / "package.json").read_text(encoding="utf-8"))
    return sorted({*table["dependencies"], *table["devDependencies"]})


def _names(lines: list[str]) -> list[str]:
    return sorted({normal(re.split(r"[^\w.-]", line, maxsplit=1)[0]) for line in lines})


def normal(name: str) -> str:
    """Returns a package's name as registries compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def imported(folders: tuple[str, ...] = SOURCES) -> set[str]:
    """Returns the normalised names of the packages whose modules some source imports."""
    modules = set()
    for folder in folders:
        for path in (ROOT / folder).rglob("*.py"):
            if "node_modules" not in path.parts:
                imports = imports_of(path.read_text(encoding="utf-8"))
                modules |= {each.module.partition(".")[0] for each in imports}
    return {normal(package) for module in modules for package in _providers().get(module, [])}


@functools.cache
def _providers() -> Mapping[str, list[str]]:
    return metadata.packages_distributions()


def used_elsewhere(name: str) -> bool:
    """Whether the file in `USED_BY` still uses the package."""
    if name not in USED_BY:
        return False
    path, text = USED_BY[name]
    file = ROOT / path
    return file.is_file() and text in file.read_text(encoding="utf-8")
