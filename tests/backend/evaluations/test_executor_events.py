"""Messages of an executor are bounded before they are believed."""

from __future__ import annotations

import json

import pytest

from backend.evaluations.executor_events import (
    MOST_LINE,
    Begun,
    Done,
    Ended,
    Refusal,
    depth_of,
    read,
    read_line,
)
from tests.backend.evaluations.conftest import done, line

DONE = {
    "job": "a",
    "seed": 1,
    "cpu_s": 1,
    "done": 1,
    "wanted": 2,
    "rate": 1,
    "low": 0,
    "high": 1,
    "left_s": 0,
}


def sent(command: str, data: object, name: str = "a") -> str:
    return json.dumps({"id": name, "command": command, "data": data, "seq": 1, "t": 0})


def test_only_messages_of_evaluations_are_read():
    assert read(sent("tick", {"whatever": 1})) is None
    assert read(sent("error", {"message": "for all"}, "")) is None
    assert isinstance(read(sent("error", {"code": "x", "message": "no"})), Refusal)
    assert isinstance(read(sent("evaluation_ended", {"job": "a", "end": "complete", "wanted": 3})), Ended)
    assert isinstance(read(sent("evaluation_outcome", DONE | {"line": line(1)})), Done)


@pytest.mark.parametrize(
    "bad",
    [
        DONE | {"line": "x" * (MOST_LINE + 1)},
        DONE | {"line": "{}", "rate": 2},
        DONE | {"line": "{}", "seed": -1},
        DONE | {"line": "{}", "cpu_s": 1e300},
        DONE,
    ],
)
def test_an_outcome_beyond_its_bounds_is_refused(bad):
    with pytest.raises(ValueError, match=r"."):
        read(sent("evaluation_outcome", bad))


def test_a_plan_that_is_too_large_is_left_out():
    data = {"job": "a", "workers": 2, "seed": 0, "wanted": 3, "sequential": False, "duration_s": 5}
    found = read(sent("evaluation_started", data | {"plan": {"outlines": ["x" * (2 << 20)]}}))
    assert isinstance(found, Begun)
    assert found.plan == {}


def test_no_nul_passes_since_the_database_stores_none():
    begun = {"job": "a", "workers": 2, "seed": 0, "wanted": 3, "sequential": False, "duration_s": 5}
    found = read(sent("evaluation_started", begun | {"plan": {"outlines": ["a\0"]}}))
    assert isinstance(found, Begun)
    assert found.plan == {}
    found = read(sent("evaluation_started", begun | {"plan": {}, "notes": "a\0: left out"}))
    assert isinstance(found, Begun)
    assert found.notes == "a: left out"
    end = read(sent("evaluation_ended", {"job": "a", "end": "failed", "message": "it\0 died"}))
    assert isinstance(end, Ended)
    assert end.message == "it died"
    refusal = read(sent("error", {"message": "n\0o"}))
    assert isinstance(refusal, Refusal)
    assert refusal.message == "no"
    assert read_line(Done("a", 3, line(3, why="b\0"), 1, 1, 1, 1, 0, 1, 0)).why == "b"


@pytest.mark.parametrize(
    "more", [{"measures": {"a\0": 1}}, {"items": [{"item": "a", "holds": True, "unit": "m\0"}]}]
)
def test_a_name_with_a_nul_is_refused(more):
    with pytest.raises(ValueError, match="matching regex"):
        read_line(Done("a", 3, line(3, **more), 1, 1, 1, 1, 0, 1, 0))


def test_what_is_nested_too_deeply_is_refused():
    deep = "[" * 100_000 + "]" * 100_000
    with pytest.raises(ValueError, match="nested"):
        read(f'{{"id": "a", "command": "evaluation_started", "data": {{"plan": {deep}}}}}')
    with pytest.raises(ValueError, match="nested"):
        read_line(Done("a", 3, f'{{"seed": 3, "x": {deep}}}', 1, 1, 1, 1, 0, 1, 0))


@pytest.mark.parametrize(
    ("text", "depth"),
    [("1", 0), ("[]", 1), ('{"a": [[1]], "b": {}}', 3), (r'["[[[", "\"[[", "\\", [1]]', 2)],
)
def test_the_depth_of_json_counts_no_brackets_in_texts(text, depth):
    assert depth_of(text.encode()) == depth


def test_what_json_could_not_write_again_is_refused():
    for levels, is_fine in ((20, True), (500, False)):
        deep = "[" * levels + "]" * levels
        done_ = Done("a", 3, f'{{"seed": 3, "outcome": "success", "x": {deep}}}', 1, 1, 1, 1, 0, 1, 0)
        if is_fine:
            assert read_line(done_).seed == 3
        else:
            with pytest.raises(ValueError, match="nested"):
                read_line(done_)
        begun = '{"job": "a", "workers": 1, "seed": 0, "wanted": 1, "sequential": false, "duration_s": 1'
        begun += f', "plan": {{"x": {deep}}}}}'
        found = read(f'{{"id": "a", "command": "evaluation_started", "data": {begun}}}')
        assert isinstance(found, Begun)
        assert bool(found.plan) == is_fine


def test_the_nearest_item_is_that_which_decided_by_least():
    items = [{"item": "a", "holds": True, "margin": 0.1}, {"item": "b", "holds": False, "margin": -0.2}]
    found = read_line(done(3, "failure"))
    assert found.nearest is not None
    assert (found.nearest.margin, found.nearest.unit) == (0.5, "m")
    both = read_line(Done("a", 3, line(3, items=items), 1, 1, 1, 1, 0, 1, 0))
    assert both.nearest is not None
    assert both.nearest.item == "b"
    none = read_line(Done("a", 3, line(3, items=[]), 1, 1, 1, 1, 0, 1, 0))
    assert none.nearest is None


@pytest.mark.parametrize("text", [line(4), line(3) + "\n", line(3, "nonsense"), "[]", "\ud800"])
def test_a_line_of_another_seed_or_no_outcome_is_refused(text):
    with pytest.raises(ValueError, match=r"."):
        read_line(Done("a", 3, text, 1, 1, 1, 1, 0, 1, 0))
