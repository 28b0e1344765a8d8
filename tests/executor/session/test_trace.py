"""The stacks of a process that does not respond."""

from __future__ import annotations

from executor.session.trace import action_frame, own_frame

DUMP = """Thread 0x01 (most recent call first):
  File "actions/Other.py", line 3 in wait

Current thread 0x02 (most recent call first):
  File "/usr/lib/python3/re.py", line 10 in match
  File "actions/Go.py", line 7 in update
  File "/opt/bt/executor/application/process.py", line 99 in run
"""


def test_the_action_of_the_current_thread_is_named() -> None:
    frame = action_frame(DUMP)
    assert frame is not None
    assert (frame.file, frame.line, frame.function) == ("actions/Go.py", 7, "update")


def test_our_own_line_is_named_with_its_path_in_the_repository() -> None:
    frame = own_frame(DUMP)
    assert frame is not None
    assert (frame.file, frame.line) == ("executor/application/process.py", 99)
    assert own_frame("") is None
