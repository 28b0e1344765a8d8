"""The evaluations of a user in the zip of all their data."""

from __future__ import annotations

from backend.evaluations.mine import data_of
from tests.backend.evaluations.conftest import done, line, store, wish


def test_all_data_of_a_user_holds_their_evaluations_alone(people):
    found = wish(people, "editor")
    store(found, done(1), done(0))
    wish(people)
    more = data_of(None, user=people.editor.user)
    [told] = more.document["evaluations"]
    assert (told["name"], told["project__name"], told["state"]) == ("room", "Robot", "waiting")
    [(path, read)] = more.files
    assert path == f"evaluations/{found.id}/revision-1.jsonl"
    assert b"".join(read()).decode().splitlines() == [line(0), line(1)]
