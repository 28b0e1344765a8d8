"""The Python code of one leaf is sampled while it is ticked."""

from __future__ import annotations

import sys
import threading
import time

from executor.application import sampling
from executor.application.sampling import Sampler


def code(source: str, file: str = "actions/Busy.py"):
    """The functions of a module of the project."""
    names: dict = {}
    exec(compile(source, file, "exec"), names)  # noqa: S102 - a module of this test
    return names


BUSY = """
def outer(look):
    return inner(look)

def inner(look):
    return look()
"""


def idle(uid: int = 0) -> Sampler:
    """A sampler of node 3 that looks only when `look` is called."""
    return Sampler(3, lambda: uid)


def test_a_stack_begins_at_the_outermost_call_of_the_projects_code():
    sampler = idle()
    code(BUSY)["outer"](lambda: sampler.look(sys._getframe()))
    sampler.close()
    [stack] = sampler.stacks()
    assert stack.frames[:2] == ["outer (actions/Busy.py:3)", "inner (actions/Busy.py:6)"]
    assert "lambda" in stack.frames[2]
    assert len(stack.frames) == 3
    assert stack.samples == sampler.samples == 1


def test_code_outside_of_the_project_counts_for_nothing():
    sampler = idle()
    sampler.look(sys._getframe())
    sampler.look(None)
    sampler.close()
    assert (sampler.samples, sampler.stacks()) == (0, [])


def test_the_most_frequent_stacks_are_reported_and_their_number_is_bounded(monkeypatch):
    monkeypatch.setattr(sampling, "MOST_STACKS", 2)
    monkeypatch.setattr(sampling, "MOST_KEPT", 3)
    sampler = idle()
    for name, times in (("a", 1), ("b", 3), ("c", 2), ("d", 5)):
        functions = code(f"def {name}(look):\n    look()\n")
        for _ in range(times):
            functions[name](lambda: sampler.look(sys._getframe()))
    sampler.close()
    assert [(each.frames[0][0], each.samples) for each in sampler.stacks()] == [("b", 3), ("c", 2)]
    assert sampler.samples == 11


def test_frames_are_short_and_few():
    deep = "def f(n, look):\n    return f(n - 1, look) if n else look()\n"
    sampler = idle()
    code(deep)["f"](100, lambda: sampler.look(sys._getframe()))
    code("def f(look):\n    look()\n", f"actions/{'x' * 500}.py")["f"](lambda: sampler.look(sys._getframe()))
    sampler.close()
    assert {len(each.frames) for each in sampler.stacks()} == {sampling.MOST_FRAMES, 2}
    assert max(len(frame) for each in sampler.stacks() for frame in each.frames) == sampling.LONGEST_FRAME


def test_the_thread_that_ticks_is_seen_only_while_the_leaf_is_ticked():
    current = [0]
    sampler = Sampler(3, lambda: current[0])
    work = code("def work(is_done):\n    while not is_done():\n        pass\n")["work"]

    def works(uid: int, is_done) -> None:
        current[0] = uid
        work(is_done)
        current[0] = 0

    # Another leaf works for so long that a look at it would have happened.
    until_s = time.monotonic() + 20 * sampling.INTERVAL_S
    works(4, lambda: time.monotonic() > until_s)
    assert sampler.samples == 0
    works(3, lambda: sampler.samples >= 2)
    assert sampler.stacks()[0].frames[0].startswith("work (actions/Busy.py:")
    sampler.close()
    for thread in threading.enumerate():
        if thread.name == "sampler":
            thread.join(5)
    seen = sampler.samples
    current[0] = 3
    until_s = time.monotonic() + 10 * sampling.INTERVAL_S
    work(lambda: time.monotonic() > until_s)
    assert sampler.samples == seen


def test_a_debugger_of_python_neither_traces_nor_suspends_the_thread():
    sampler = idle()
    [thread] = [each for each in threading.enumerate() if each.name == "sampler" and each.is_alive()][-1:]
    marks = {"pydev_do_not_trace": True, "is_pydev_daemon_thread": True}
    assert marks.items() <= vars(thread).items()
    sampler.close()
