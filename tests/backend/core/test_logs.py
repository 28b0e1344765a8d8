"""Lines of the log, and facts that are left out."""

from __future__ import annotations

import json
import logging

import pytest

from backend.core.logs import MOST_ALIKE, PERIOD_S, Flood, JsonFormatter, TextFormatter


class Clock:
    now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def written(clock):
    """A logger and the lines that it wrote."""
    lines = []

    class Kept(logging.Handler):
        def emit(self, record):
            lines.append(record.getMessage())

    handler, logger = Kept(), logging.getLogger("tests.flood")
    logger.handlers.clear()
    handler.addFilter(Flood(clock))
    logger.addHandler(handler)
    return logger, lines


def test_lines_of_one_kind_are_written_so_many_times_in_a_period(written):
    logger, lines = written
    for number in range(MOST_ALIKE + 30):
        logger.warning("invalid request %d", number)
        logger.warning("another kind")
    assert lines.count("another kind") == MOST_ALIKE
    assert [line for line in lines if "invalid" in line][-1] == f"invalid request {MOST_ALIKE - 1}"


def test_the_next_period_begins_with_how_many_were_dropped(written, clock):
    logger, lines = written
    for number in range(MOST_ALIKE + 30):
        logger.warning("invalid request %d", number)
    clock.now_s += PERIOD_S
    logger.warning("invalid request %d", 99)
    logger.warning("invalid request %d", 100)
    assert lines[-2:] == ["invalid request 99 (30 more of these came before)", "invalid request 100"]


def test_no_error_is_dropped(written):
    logger, lines = written
    for _ in range(MOST_ALIKE + 30):
        logger.error("a fault")
    assert len(lines) == MOST_ALIKE + 30


def record(**facts: object) -> logging.LogRecord:
    made = logging.LogRecord("backend.x", logging.WARNING, "x.py", 1, "lost\n%s", ("this",), None)
    if facts:
        made.facts = facts
    return made


def test_a_record_is_one_object_in_one_line() -> None:
    text = JsonFormatter().format(record(user="ada"))
    line = json.loads(text)
    assert "\n" not in text
    assert (line["level"], line["message"], line["user"]) == ("warning", "lost\nthis", "ada")


def test_an_exception_and_what_json_does_not_know_are_texts() -> None:
    made = record(what=object())
    try:
        raise ValueError("no")
    except ValueError as error:
        made.exc_info = (type(error), error, error.__traceback__)
    assert "ValueError: no" in json.loads(JsonFormatter().format(made))["exception"]


def test_people_read_the_facts_behind_the_text() -> None:
    assert TextFormatter().format(record(user="ada")).endswith(" user=ada")
