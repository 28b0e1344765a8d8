"""Breakpoints and forced results become hooks of the other program, and nothing else stays there."""

from __future__ import annotations

from typing import Any

import pytest

from executor import child_messages, messages
from executor.attached.control import Control, RefusedError, explain
from executor.attached.following import Statuses
from executor.messages import TreeNode
from tree_gardener.groot import GrootError
from tree_gardener.groot.protocol import Hook, HookKey, Mode, Position, Unlock
from tree_gardener.groot.remote import NodeState
from tree_gardener.status import Status

BEFORE, AFTER = Position.BEFORE, Position.AFTER
NODES = [
    TreeNode(1, 0, "Sequence", "Control", "top", "top", "u11", "Main"),
    TreeNode(2, 1, "SubTree", "SubTree", "a", "a", "u12", "Main"),
    TreeNode(3, 2, "Look", "Action", "look", "a/look", "u13", "Sub"),
    TreeNode(4, 1, "SubTree", "SubTree", "b", "b", "u14", "Main"),
    TreeNode(5, 4, "Look", "Action", "look", "b/look", "u13", "Sub"),
]
NUMBERS = {10 + uid: uid for uid in range(1, 6)}


class Program:
    """The hooks of the other program."""

    def __init__(self) -> None:
        self.there: dict[HookKey, Hook] = {}
        self.unlocked: list[Unlock] = []

    def insert(self, hooks: Any) -> None:
        self.there.update({hook.key: hook for hook in hooks})

    def remove(self, key: HookKey) -> None:
        del self.there[key]

    def hooks(self) -> list[Hook]:
        return list(self.there.values())

    def unlock(self, answer: Unlock) -> None:
        self.unlocked.append(answer)

    @property
    def keys(self) -> list[tuple[int, Position]]:
        return sorted((key.uid, key.position) for key in self.there)


class Rig:
    def __init__(self) -> None:
        self.program = Program()
        self.said: list[Any] = []
        statuses = Statuses(NUMBERS)
        statuses.take({11: NodeState(Status.RUNNING)}, 0.0)
        self.control = Control(NODES, NUMBERS, self.program, self.said.append, statuses)

    def breakpoints(self, *places: tuple[str, str], **fields: Any) -> None:
        wanted = [messages.Breakpoint(tree, node, **fields) for tree, node in places]
        self.control.obey(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints(wanted)))

    def on(self, *, on: bool = True) -> None:
        self.control.obey(child_messages.Control(on=on))

    def force(self, uid: int, path: str, status: Any = "SUCCESS", **fields: Any) -> None:
        forced = messages.Force(uid, path, status=status, **fields)
        self.control.obey(child_messages.ForceResult(force=forced))

    def forced(self) -> list[tuple[int, str]]:
        last = [each for each in self.said if isinstance(each, child_messages.Forced)][-1]
        return [(node.uid, node.status) for node in last.nodes]


def test_nothing_is_set_while_one_only_looks() -> None:
    rig = Rig()
    rig.breakpoints(("Sub", "u13"))
    assert rig.program.keys == []
    with pytest.raises(RefusedError) as refused:
        rig.force(3, "a/look")
    assert refused.value.error.code == "no_control"
    rig.control.reached(13)
    assert not rig.control.is_holding
    rig.on()
    assert rig.program.keys == [(13, BEFORE), (15, BEFORE)]
    rig.on(on=False)
    assert rig.program.keys == []


def test_a_breakpoint_is_at_all_instances_or_at_one() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"), when="after")
    assert rig.program.keys == [(13, AFTER), (15, AFTER)]
    rig.breakpoints(("Sub", "u13"), instance=["u14"])
    assert rig.program.keys == [(15, BEFORE)]
    rig.breakpoints(("Sub", "gone"))
    assert rig.program.keys == []


@pytest.mark.parametrize(
    "fields", [{"when": "returns", "status": "FAILURE"}, {"condition": "a == 1"}, {"hits": 2}, {"log": "x"}]
)
def test_breakpoints_that_the_protocol_lacks_are_refused(fields: dict[str, Any]) -> None:
    rig = Rig()
    with pytest.raises(RefusedError, match="before and after"):
        rig.breakpoints(("Sub", "u13"), **fields)


def test_a_hold_has_its_path_and_ends_with_continue() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.control.reached(15)
    held = rig.said[-1]
    assert (held.uid, held.path, held.event, held.statuses) == (5, [1, 4, 5], "before", [(1, "RUNNING")])
    with pytest.raises(RefusedError, match="no steps"):
        rig.control.obey(child_messages.Continue(step="over"))
    rig.control.obey(child_messages.Continue())
    assert rig.program.unlocked == [Unlock(HookKey(15, BEFORE), Status.SKIPPED, remove_when_done=False)]
    assert any(isinstance(each, child_messages.Released) for each in rig.said)
    assert not rig.control.is_holding


def test_the_two_breakpoints_of_a_node_alternate() -> None:
    rig = Rig()
    rig.on()
    wanted = [messages.Breakpoint("Main", "u11"), messages.Breakpoint("Main", "u11", when="after")]
    rig.control.obey(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints(wanted)))
    events = []
    for _ in range(4):
        rig.control.reached(11)
        events.append(
            next(each for each in reversed(rig.said) if isinstance(each, child_messages.Held)).event
        )
        rig.control.obey(child_messages.Continue())
    assert events == ["before", "after", "before", "after"]


def test_removing_the_breakpoint_lets_the_held_tree_run_on() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.control.reached(13)
    rig.breakpoints()
    assert not rig.control.is_holding
    assert isinstance(rig.said[-2], child_messages.Released)


def test_results_are_forced_and_released() -> None:
    rig = Rig()
    rig.on()
    rig.force(3, "a/look", "FAILURE", once=True)
    hook = rig.program.there[HookKey(13, BEFORE)]
    assert (hook.mode, hook.once, hook.desired_status) == (Mode.REPLACE, True, Status.FAILURE)
    assert rig.forced() == [(3, "FAILURE")]
    rig.program.remove(hook.key)  # it was reached
    rig.control.refresh()
    assert rig.forced() == []
    rig.force(3, "a/look", after=True)
    assert rig.program.keys == [(13, AFTER)]
    rig.control.obey(child_messages.ReleaseForced())
    assert rig.program.keys == []


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"status": "RUNNING"}, "not_forced"),
        ({"status": "SKIPPED"}, "not_forced"),
        ({"effect": "skip_to"}, "not_forced"),
        ({"effect": "alone"}, "not_forced"),
    ],
)
def test_what_the_protocol_cannot_force_is_refused(fields: dict[str, Any], code: str) -> None:
    rig = Rig()
    rig.on()
    with pytest.raises(RefusedError) as refused:
        rig.force(3, "a/look", **fields)
    assert refused.value.error.code == code
    with pytest.raises(RefusedError, match="not in the tree"):
        rig.force(3, "other/path")


def test_a_result_at_the_held_node_is_given_when_it_continues() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.control.reached(13)
    rig.force(3, "a/look", "FAILURE", once=True)
    assert rig.program.there[HookKey(13, BEFORE)].mode is Mode.BREAKPOINT
    rig.control.obey(child_messages.Continue())
    assert rig.program.unlocked[-1].desired_status is Status.FAILURE
    assert rig.forced() == []
    assert rig.program.there[HookKey(13, BEFORE)].mode is Mode.BREAKPOINT


def test_hooks_that_the_page_does_not_show_are_removed() -> None:
    rig = Rig()
    stray = Hook(
        HookKey(12, BEFORE), Mode.BREAKPOINT, once=False, desired_status=Status.SKIPPED, enabled=True
    )
    rig.program.insert([stray])
    rig.control.restore()
    assert rig.program.keys == [(12, BEFORE)]  # one who only looks changes nothing
    rig.on()
    assert rig.program.keys == []
    rig.breakpoints(("Main", "u12"))
    rig.program.insert([stray])
    rig.program.there.clear()
    rig.control.restore()
    assert rig.program.keys == [(12, BEFORE)]


def test_a_program_that_is_lost_while_held_is_not_held_any_more() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.control.reached(13)
    rig.control.lost()
    assert isinstance(rig.said[-1], child_messages.Released)
    assert explain(GrootError("no answer")).code == "other_program"


def test_hooks_are_withdrawn_and_put_back() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.control.reached(13)
    rig.control.withdraw()
    assert rig.program.keys == []
    assert not rig.control.is_holding
    rig.control.refresh()
    assert rig.program.keys == [(13, BEFORE), (15, BEFORE)]


def test_what_the_program_did_not_take_is_not_kept() -> None:
    rig = Rig()
    rig.on()
    rig.program.hooks = lambda: (_ for _ in ()).throw(GrootError("no answer"))  # type: ignore[method-assign]
    with pytest.raises(GrootError):
        rig.force(3, "a/look")
    del rig.program.hooks
    rig.control.restore()
    assert rig.program.keys == []


def test_the_end_removes_all() -> None:
    rig = Rig()
    rig.on()
    rig.breakpoints(("Sub", "u13"))
    rig.force(1, "top")
    rig.control.end()
    assert rig.program.keys == []
