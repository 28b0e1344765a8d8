"""A process reports that it lives, and where it is."""

from __future__ import annotations

import queue
import sys
from typing import TYPE_CHECKING

from executor.supervision.channel import ChannelClosed
from executor.supervision.pulse import Pulse, place_in_our_code

if TYPE_CHECKING:
    from executor.child_messages import Beat


def test_beats_tell_the_task_and_the_turns() -> None:
    beats: queue.Queue[Beat] = queue.Queue()
    is_over = False

    def send(beat: Beat) -> None:
        if is_over:
            raise ChannelClosed
        beats.put(beat)

    pulse = Pulse(send)
    assert beats.get(timeout=60).task == "starting"
    pulse.rests()
    with pulse.busy("loading"):
        while (beat := beats.get(timeout=60)).task != "loading":
            pass
    assert beat.turns >= 2
    is_over = True


def test_a_place_in_our_code_has_its_path_in_the_repository() -> None:
    place = place_in_our_code(sys._getframe())
    assert place.text.startswith("tests/executor/supervision/test_pulse.py:")
    assert place_in_our_code(None).text == ""
