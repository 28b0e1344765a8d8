"""Names of ROS packages, derived from the titles of projects."""

from __future__ import annotations

import keyword
import re
import sys
import unicodedata

from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.package.rosdep import rosdep_table
from translator.settings import PROJECT_FILE, Settings

SUFFIX = "_bt"
MAX_LENGTH = 80
# The rule of catkin_pkg; colcon builds a package that it refuses as one of another type.
_ADDRESS = re.compile(r"[-\w%+]+(\.[-\w%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}", re.ASCII)
_VALID = re.compile(r"[a-z][a-z0-9_]*[a-z0-9]")
# Folders of a colcon workspace and of a package, and the name of the engine's package.
_RESERVED = {
    "build",
    "install",
    "log",
    "src",
    "test",
    "tests",
    "actions",
    "launch",
    "tree_gardener",
    "tree_tools",
}


def package_name(title: str) -> str:
    """Returns a valid name of a ROS package for a project's title."""
    ascii_text = unicodedata.normalize("NFKD", title).encode("ascii", "ignore").decode("ascii").lower()
    name = re.sub(r"[^a-z0-9]+", "_", ascii_text).strip("_")[:MAX_LENGTH].strip("_")
    if not name:
        return "robot" + SUFFIX
    if not name[0].isalpha():
        name = f"robot_{name}"
    return name if problem_with(name) is None else f"{name}{SUFFIX}"


def problem_with(name: str) -> str | None:
    """Returns the reason why a text cannot be the name of a package, or None if it can."""
    if len(name) > MAX_LENGTH + len(SUFFIX):
        return "it is too long"
    if _VALID.fullmatch(name) is None or "__" in name:
        return "it must be lower case letters, digits and single _, begin with a letter and be 2 long"
    if keyword.iskeyword(name) or keyword.issoftkeyword(name) or name in sys.stdlib_module_names:
        return "it means something in Python"
    if name in _RESERVED:
        return "the workspace uses it"
    if name in rosdep_table().ros_packages or name in rosdep_table().imports:
        return "another package has it"
    return None


def maintainer_problems(settings: Settings) -> list[Diagnostic]:
    """Returns an error if ROS's tools would refuse the maintainer's address."""
    email = settings.maintainer.email
    if not email or _ADDRESS.fullmatch(email):
        return []
    return [diagnostic("BT0901", Place(PROJECT_FILE, line=1), email=email)]


def require_maintainer(settings: Settings) -> None:
    """Checks the maintainer's address.

    Raises:
        TranslatorError: If ROS's tools would refuse it.
    """
    if problems := maintainer_problems(settings):
        raise TranslatorError(problems)


def require_name(name: str) -> str:
    """Checks a package name that a user chose, and returns it unchanged.

    Raises:
        TranslatorError: If the name is not valid for a ROS package.
    """
    problem = problem_with(name)
    if problem is not None:
        place = Place(PROJECT_FILE, line=1)
        values = {"name": name, "problem": problem, "suggestion": package_name(name)}
        raise TranslatorError([diagnostic("BT0900", place, **values)])
    return name
