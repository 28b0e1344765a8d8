"""An imported part is one revision of its project."""

from __future__ import annotations

import json
from uuid import UUID

import pytest

from backend.imports.errors import PartTakenError
from backend.imports.writes import FreeNames, Part, require_free, write_part
from backend.projects.errors import PreconditionFailedError
from backend.projects.storage.changes import Content


class Counted(list[str]):
    """Paths that count how often they are gone through."""

    times = 0

    def __iter__(self):
        self.times += 1
        return super().__iter__()


def test_a_name_is_free_if_nothing_of_that_kind_has_it_in_any_case():
    paths = [
        "robots/Cart/robot.yaml",
        "universes/yard.yaml",
        "assets/hall/a.stl",
        "robots/notes",
        "robots/c_2/a",
    ]
    robots, universes = FreeNames("robot", paths), FreeNames("universe", paths)
    assert [robots.like(name) for name in ("cart", "yard", "notes", "c")] == ["cart_2", "yard", "notes", "c"]
    assert [universes.like(name) for name in ("Yard", "hall", "car")] == ["Yard_2", "hall_2", "car"]
    with pytest.raises(PartTakenError, match="has a universe"):
        require_free("universe", "yard", paths)


def test_the_paths_are_gone_through_once_however_many_names_are_taken():
    paths = Counted(f"robots/x{tail}/robot.yaml" for tail in ("", *(f"_{n}" for n in range(2, 5_001))))
    free = FreeNames("robot", paths)
    assert {free.like(name) for name in ["x"] * 500} == {"x_5001"}
    assert free.like("x" * 60) == "x" * 60
    assert paths.times == 1
    with pytest.raises(PartTakenError) as error:
        require_free("robot", "x", paths)
    assert (error.value.extra["name"], paths.times) == ("x_5001", 2)


def test_a_part_is_written_replaced_and_used_in_one_revision_or_not_at_all(api, project, user):
    id_ = UUID(project["id"])
    first = {"robots/a/robot.yaml": Content.of(b"1"), "robots/a/a.stl": Content.of(b"2")}
    made = write_part(
        id_, Part("robot", "a", is_used=True, replaces=False), first, acting_user=user, if_match=""
    )
    assert (made.project.revision, made.previous, made.removed) == (2, 1, [])
    with pytest.raises(PartTakenError):
        write_part(
            id_, Part("robot", "a", is_used=False, replaces=False), first, acting_user=user, if_match=""
        )
    again = Part("robot", "a", is_used=False, replaces=True)
    with pytest.raises(PreconditionFailedError):
        write_part(id_, again, first, acting_user=user, if_match='"1-x"')
    made = write_part(id_, again, {"robots/a/robot.yaml": Content.of(b"3")}, acting_user=user, if_match="")
    assert (made.project.revision, made.removed) == (3, ["robots/a/a.stl"])
    found = api.get(f"projects/{project['id']}")
    assert {file["path"] for file in found["files"] if file["path"].startswith("robots/")} == {
        "robots/a/robot.yaml"
    }
    settings = json.loads(api.get(f"projects/{project['id']}/files/project.json"))
    assert settings["robot"] == "a"
