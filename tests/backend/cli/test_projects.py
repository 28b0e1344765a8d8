"""`bt-studio projects`."""

from __future__ import annotations

import json

from backend.cli.new import new
from backend.cli.projects import projects


def test_projects_are_listed_and_searched(stored_place, capsys):
    new("Rover")
    new("Arm")
    capsys.readouterr()
    projects("rov", as_json=True)
    assert [row["name"] for row in json.loads(capsys.readouterr().out)] == ["Rover"]
