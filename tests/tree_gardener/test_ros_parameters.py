"""The parameters of the node that ticks a tree."""

from __future__ import annotations

import pytest

from tree_gardener.ros_parameters import NAMES, ParameterError, read_arguments


def test_the_words_of_a_command_line_are_read() -> None:
    assert read_arguments(["--tick_hz=5", "--on_finish=repeat"]) == {"tick_hz": 5.0, "on_finish": "repeat"}
    assert read_arguments([]) == {}


@pytest.mark.parametrize("word", ["tick_hz=5", "--tick_hz", "--speed=3", "--use_sim_time=perhaps"])
def test_a_word_that_is_no_parameter_is_refused(word: str) -> None:
    with pytest.raises(ParameterError):
        read_arguments([word])
    assert "tick_hz" in NAMES
