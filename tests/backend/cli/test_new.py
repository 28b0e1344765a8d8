"""`bt-studio new`."""

from __future__ import annotations

import pytest

from backend.cli.new import new
from backend.cli.shared.errors import CliError
from backend.projects.models import Project


def test_a_project_is_made_once(stored_place):
    new("Rover")
    assert [project.name for project in Project.objects.all()] == ["Rover"]
    with pytest.raises(CliError, match="name_taken"):
        new("Rover")
