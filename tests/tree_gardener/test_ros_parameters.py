"""The parameters of the node that ticks a tree."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from tree_gardener.ros_parameters import (
    ParameterError,
    ServerParameters,
    asks_for_help,
    help_text,
    read_arguments,
)


def test_the_words_of_a_command_line_are_read() -> None:
    assert read_arguments(["--tick_hz=5", "--on_finish=repeat"]) == {"tick_hz": 5.0, "on_finish": "repeat"}
    assert read_arguments([]) == {}


@pytest.mark.parametrize("word", ["tick_hz=5", "--tick_hz", "--speed=3", "--use_sim_time=perhaps"])
def test_a_word_that_is_no_parameter_is_refused(word: str) -> None:
    with pytest.raises(ParameterError):
        read_arguments([word])


def test_a_server_has_parameters_of_its_own() -> None:
    words = ["--action_name=/run", "--on_new_goal=queue"]
    assert read_arguments(words, ServerParameters) == {"action_name": "/run", "on_new_goal": "queue"}
    with pytest.raises(ParameterError, match="--on_new_goal=…"):
        read_arguments(["--on_finish=repeat"], ServerParameters)
    with pytest.raises(ParameterError):
        read_arguments(words)


def test_help_has_every_parameter_with_its_default() -> None:
    defaults = ServerParameters(Path("a/t.xml"), 12.5, "stop", "bt_execution", "queue")
    text = help_text("patrol", "Runs trees.", defaults)
    for field in dataclasses.fields(defaults):
        assert f"--{field.name}=…" in text
    assert "(default: 12.5)" in text
    assert "(default: 'a/t.xml')" in text
    assert "on_finish" not in text


@pytest.mark.parametrize(
    ("words", "asks"),
    [
        (["--help"], True),
        (["--tick_hz=5", "-h"], True),
        (["--ros-args", "-r", "a:=b", "--", "--help"], True),
        (["--ros-args", "-h"], False),
        (["--tick_hz=5"], False),
        ([], False),
    ],
)
def test_whether_a_command_line_asks_for_help(words: list[str], asks: bool) -> None:
    assert asks_for_help(words) is asks
