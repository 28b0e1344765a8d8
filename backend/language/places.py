"""Selects the support for Python: child processes on localhost, containers on servers that have them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from backend.config.environment import environment
from backend.language import ruff, tools
from backend.language.containers import ContainerLauncher
from backend.language.errors import CheckerUnavailableError, UnavailableError
from backend.language.servers import Launcher, ProcessLauncher

if TYPE_CHECKING:
    from backend.accounts.models import User

_MISSING = "This server has no containers, and without them it offers no help with Python."


def launcher() -> Launcher:
    """Returns the launcher of language servers.

    Raises:
        UnavailableError: this server offers no language servers.
    """
    if environment().has_containers:
        return ContainerLauncher()
    if environment().is_team:
        raise UnavailableError(_MISSING)
    return ProcessLauncher()


def checker(user: User) -> ruff.Run:
    """Returns the function that runs ruff.

    Raises:
        CheckerUnavailableError: this server offers no checker.
    """
    if environment().has_containers:
        return partial(tools.run_ruff, user)
    if environment().is_team:
        raise CheckerUnavailableError(_MISSING)
    return ruff.run_beside
