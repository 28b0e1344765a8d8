"""The selection of the support for Python."""

from __future__ import annotations

from functools import partial

import pytest

from backend.language import ruff, tools
from backend.language.containers import ContainerLauncher
from backend.language.errors import CheckerUnavailableError, UnavailableError
from backend.language.places import checker, launcher
from backend.language.servers import ProcessLauncher


def test_on_this_machine_it_is_a_child_process(user) -> None:
    assert isinstance(launcher(), ProcessLauncher)
    assert checker(user) is ruff.run_beside


def test_a_team_has_it_in_containers_or_not_at_all(team, settings_of, person) -> None:
    ada = person("ada").user
    with pytest.raises(UnavailableError):
        launcher()
    with pytest.raises(CheckerUnavailableError):
        checker(ada)
    for with_containers in ("docker", "kubernetes"):
        settings_of(launcher=with_containers)
        assert isinstance(launcher(), ContainerLauncher)
        run = checker(ada)
        assert isinstance(run, partial)
        assert run.func is tools.run_ruff
