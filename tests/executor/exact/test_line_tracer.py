"""Following the code of actions: lines, values, ends, and what is left out."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from executor.application.locate import Locator
from executor.exact import line_tracer
from executor.exact.line_tracer import LineTracer
from executor.source_events import MOST_CALLS, MOST_SOURCE_BYTES

if TYPE_CHECKING:
    import pytest

    from executor.child_messages import TickSource
    from executor.source_events import SourceCall

ACT = """\
class Act:
    def __init__(self):
        self.number = 0
        self.seen = []

    def update(self, goal=3):
        total = 0
        for step in range(goal):
            total += step
        self.number += 1
        self.seen.append(total)
        return helped(total)


def helped(value):
    squares = [each * each for each in range(value)]
    if not squares:
        raise ValueError("none")
    return squares
"""


HELP = """\
class Base:
    def __init__(self):
        self.scale = 2

    def scaled(self, value):
        factor = self.scale
        return factor * value
"""


class Files:
    """A project with one action and a module beside it."""

    def __init__(self, source: str = ACT) -> None:
        self.texts = {"actions/Act.py": source, "/run/1/lib/help.py": HELP}

    def file_of(self, path: str) -> str:
        return path.removeprefix("/run/1/") if path in self.texts else ""

    def text_of(self, path: str, most_bytes: int) -> str | None:
        text = self.texts[path]
        return text if len(text) <= most_bytes else None


def loaded(source: str = ACT, file: str = "actions/Act.py") -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(compile(source, file, "exec"), names)  # noqa: S102 - an action
    return names


def followed(run: Any, source: str = ACT) -> TickSource:
    """Returns what is found while a function runs."""
    tracer = LineTracer(Locator(), Files(source))
    with suppress(ValueError), tracer:
        tracer.is_in_tick = True
        run()
    return tracer.source(1.5, 30)


def lines(call: SourceCall) -> dict[int, int]:
    return {line.line: line.times for line in call.lines}


def values(call: SourceCall, number: int) -> dict[str, str]:
    (line,) = [line for line in call.lines if line.line == number]
    return {value.name: value.text for value in line.values}


def named(found: list[Any]) -> dict[str, str]:
    return {value.name: value.text for value in found}


def test_lines_and_values_are_those_of_the_call() -> None:
    act = loaded()["Act"]()
    found = followed(lambda: act.update(4))
    update, helped = found.calls
    assert (found.t, found.tick, found.left_out, found.is_cut) == (1.5, 30, 0, False)
    assert (update.file, update.function, update.line) == ("actions/Act.py", "Act.update", 6)
    assert (update.uid, update.path, update.part) == (0, "", "tick")
    assert lines(update) == {6: 0, 7: 1, 8: 5, 9: 4, 10: 1, 11: 1, 12: 1}
    assert values(update, 6) == {"goal": "4"}
    assert values(update, 9) == {"total": "6"}
    assert values(update, 8) == {"step": "3"}
    assert values(update, 10) == {"self.number": "1"}
    assert values(update, 11) == {"self.seen": "[6]"}  # changed in place
    assert named(update.locals) == {"goal": "4", "total": "6", "step": "3"}
    assert named(update.fields) == {"self.number": "1", "self.seen": "[6]"}
    assert (update.end, update.result) == ("returned", "[0, 1, 4, 9, 16, 25]")
    assert (helped.function, helped.end) == ("helped", "returned")
    assert lines(helped)[16] >= 6  # the comprehension is a part of the function
    assert found.files == {"actions/Act.py": ACT}


def test_an_exception_ends_the_calls_that_do_not_handle_it() -> None:
    act = loaded()["Act"]()
    update, helped = followed(lambda: act.update(0)).calls
    assert (update.end, update.result) == ("raised", "ValueError: none")
    assert helped.end == "raised"
    assert 19 not in lines(helped)

    handled = "def do():\n    try:\n        int('x')\n    except ValueError:\n        pass\n    return 7\n"
    (call,) = followed(loaded(handled)["do"]).calls
    assert (call.end, call.result) == ("returned", "7")


def test_modules_of_the_project_are_followed_too() -> None:
    names = loaded(HELP, "/run/1/lib/help.py")
    source = "class Act(Base):\n    def update(self):\n        return self.scaled(21)\n"
    exec(compile(source, "actions/Act.py", "exec"), names)  # noqa: S102 - an action
    act = names["Act"]()
    found = followed(act.update, source)
    update, scaled = found.calls
    assert (update.file, update.result) == ("actions/Act.py", "42")
    assert (scaled.file, scaled.function, scaled.line) == ("lib/help.py", "Base.scaled", 5)
    assert lines(scaled) == {5: 0, 6: 1, 7: 1}
    assert values(scaled, 6) == {"factor": "2"}
    assert named(scaled.fields) == {"self.scale": "2"}, "the field of a base class of the project"
    assert found.files == {"actions/Act.py": source, "lib/help.py": HELP}


def test_only_the_project_is_followed_and_callbacks_say_so() -> None:
    other = loaded("def other(call):\n    return call()\n", "/usr/lib/other.py")["other"]
    helped = loaded()["helped"]
    tracer = LineTracer(Locator(), Files())
    helped(2)
    with tracer:
        other(lambda: helped(2))
    helped(2)
    (call,) = tracer.calls
    assert (call.function, call.part) == ("helped", "callback")
    assert tracer.has_run


def test_fields_of_base_classes_outside_of_the_actions_are_hidden() -> None:
    class Base:
        def __init__(self) -> None:
            self.logger = 1

    names = {"Base": Base}
    source = "class Act(Base):\n    def update(self):\n        self.own = 2\n"
    exec(compile(source, "actions/Act.py", "exec"), names)  # noqa: S102 - an action
    act: Any = names["Act"]()
    (call,) = followed(act.update).calls
    assert named(call.fields) == {"self.own": "2"}


def test_values_that_cannot_be_shown_are_named() -> None:
    source = (
        "class Bad:\n    def __repr__(self):\n        raise KeyError('no')\n"
        "def do():\n    bad = Bad()\n    text = 'x' * 5000\n    return None\n"
    )
    (call,) = followed(loaded(source)["do"]).calls
    assert "repr raised KeyError" in named(call.locals)["bad"] or "Bad" in named(call.locals)["bad"]
    assert len(named(call.locals)["text"]) <= 200
    assert call.result == "None"


def test_much_that_happens_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    helped = loaded()["helped"]
    found = followed(lambda: [helped(1) for _ in range(MOST_CALLS + 7)])
    assert (len(found.calls), found.left_out) == (MOST_CALLS, 7)
    loop = loaded("def do():\n    for step in range(100_000):\n        pass\n")["do"]
    found = followed(loop)
    assert found.is_cut
    assert found.calls[0].end == "open"
    monkeypatch.setattr(line_tracer, "MOST_CHARACTERS", 100)
    act = loaded()["Act"]()
    assert followed(lambda: act.update(30)).is_cut


def test_a_file_that_is_too_long_is_left_out() -> None:
    helped = loaded()["helped"]
    assert followed(lambda: helped(1), ACT + "#" * MOST_SOURCE_BYTES).files == {}
