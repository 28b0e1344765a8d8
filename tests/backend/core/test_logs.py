"""Lines of the log, and facts that are left out."""

from __future__ import annotations

import json
import logging

import pytest
from redis.exceptions import ConnectionError as RedisConnectionError

from backend.core.logs import (
    LAYER,
    MOST_ALIKE,
    PERIOD_S,
    Flood,
    JsonFormatter,
    LostRedis,
    TextFormatter,
)


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


def lost(error: Exception, name: str = LAYER) -> logging.LogRecord:
    why = (type(error), error, None)
    return logging.LogRecord(name, logging.ERROR, "x.py", 1, "Unexpected exception", (), why)


def test_a_lost_redis_is_one_warning_in_a_period(clock) -> None:
    told = LostRedis(clock)
    first = lost(RedisConnectionError("Connection refused"))
    assert told.filter(first)
    text = TextFormatter().format(first)
    assert " WARNING " in text
    assert text.endswith("Redis does not answer, and is asked again each second: Connection refused")
    assert not told.filter(lost(RedisConnectionError("Connection refused")))
    clock.now_s += PERIOD_S
    assert told.filter(lost(RedisConnectionError("Connection refused")))


def test_other_errors_of_the_channel_layer_and_of_others_stay_whole(clock) -> None:
    told = LostRedis(clock)
    for record in (lost(ValueError("no")), lost(RedisConnectionError("gone"), "backend.x")) * 2:
        assert told.filter(record)
        assert (record.levelno, record.msg) == (logging.ERROR, "Unexpected exception")
