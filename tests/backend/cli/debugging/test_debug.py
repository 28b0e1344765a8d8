"""`bt-studio debug`; the prompt itself is tested beside it."""

from __future__ import annotations

import pytest
import typer

from backend.cli.debugging.debug import debug
from backend.cli.shared.errors import CliError


def test_a_world_outside_is_refused() -> None:
    with pytest.raises(typer.BadParameter, match="a robot outside would keep moving"):
        debug("project", universe="none")


def test_a_project_that_does_not_exist_is_refused_with_its_name() -> None:
    with pytest.raises(CliError, match=r"no_such_project\.zip:1:1: there is no such file"):
        debug("no_such_project.zip")
