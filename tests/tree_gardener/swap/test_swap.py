"""The exchange of a running tree, as the user sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.budget import count
from tests.tree_gardener.generated.both_ways import RARE, USUAL, cases
from tests.tree_gardener.swap.swapping import compare
from tree_gardener import (
    ControlNode,
    ManualClock,
    Port,
    Status,
    TickError,
    Tree,
    get_input,
    set_output,
    tree_tools,
)
from tree_gardener.swap import Swap, SwapRefusedError

if TYPE_CHECKING:
    from tree_gardener.clock import Timer

CALLS: list[str] = []


class Drive(py_trees.behaviour.Behaviour):
    """Counts its ticks, and records its calls."""

    INPUT_PORTS: ClassVar = {"speed": Port(float, default=1.0)}
    OUTPUT_PORTS: ClassVar = {"ticks": Port(int)}

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.ticks = 0

    def setup(self, **_: Any) -> None:
        CALLS.append(f"setup {self.name}")

    def initialise(self) -> None:
        CALLS.append(f"initialise {self.name}")

    def update(self) -> PyTreesStatus:
        self.ticks += 1
        CALLS.append(f"{self.name} {self.ticks} at {get_input(self, 'speed')}")
        set_output(self, "ticks", self.ticks)
        return PyTreesStatus.RUNNING

    def terminate(self, new_status: PyTreesStatus) -> None:
        CALLS.append(f"terminate {self.name} {new_status.name}")

    def shutdown(self) -> None:
        CALLS.append(f"shutdown {self.name}")


class Changed(Drive):
    """The same action with changed code."""

    def carry_over(self, old: Drive) -> None:
        self.ticks = 100 + old.ticks


class Refusing(Drive):
    """An action that cannot take over."""

    def carry_over(self, old: Drive) -> None:
        raise ValueError(f"not from {old.ticks}")


class Unready(Drive):
    """An action that cannot be set up."""

    def setup(self, **_: Any) -> None:
        raise RuntimeError("no camera")


@pytest.fixture(autouse=True)
def calls():
    CALLS.clear()
    return CALLS


def tree_of(body: str, clock: ManualClock | None = None, **nodes: Any) -> Tree:
    text = f'<root BTCPP_format="4"><BehaviorTree ID="Main">{body}</BehaviorTree></root>'
    return Tree.from_xml(text, {"Drive": Drive, "Pause": Pause, **nodes}, clock)


class Pause(ControlNode):
    """Ticks its child after a second."""

    def setup(self, **_: Any) -> None:
        self.is_over = False
        self.timer: Timer | None = None

    def update(self) -> Status:
        if self.timer is None:
            self.timer = self.start_timer(1.0, self.end)
        return self.tick_child(0) if self.is_over else Status.RUNNING

    def end(self) -> None:
        self.is_over = True


def running(body: str, clock: ManualClock | None = None, ticks: int = 1) -> Tree:
    tree = tree_of(body, clock)
    tree.setup()
    for _ in range(ticks):
        tree.tick_exactly_once()
    CALLS.clear()
    return tree


def drive(speed: float = 1.0, extra: str = "") -> str:
    return f'<Drive _bts_id="d" name="drive" speed="{speed}" ticks="{{ticks}}"{extra}/>'


def test_a_running_action_continues_with_the_new_values_of_its_ports(calls):
    old = running(drive(1.0), ticks=2)
    new = Swap(old, tree_of(drive(2.5))).run()
    new.tick_exactly_once()
    assert calls == ["drive 3 at 2.5"]
    assert new.tick_number == 3
    assert new.blackboard["ticks"] == 3


def test_an_action_that_left_is_halted_and_shut_down(calls):
    old = running(f'<Sequence _bts_id="s">{drive()}<AlwaysSuccess _bts_id="a"/></Sequence>')
    swap = Swap(old, tree_of('<Sequence _bts_id="s"><AlwaysSuccess _bts_id="a"/></Sequence>'))
    assert swap.plan.halted == (("s",), ("d",))
    new = swap.run()
    assert calls == ["terminate drive INVALID", "shutdown drive"]
    assert new.tick_exactly_once() is Status.SUCCESS


def test_a_sequence_continues_at_its_child_where_that_is_now(calls):
    old = running(f'<Sequence _bts_id="s"><AlwaysSuccess _bts_id="a"/>{drive()}</Sequence>')
    before = '<Drive _bts_id="n" name="new" ticks="{new}"/>'
    new = Swap(old, tree_of(f'<Sequence _bts_id="s">{before}{drive()}</Sequence>')).run()
    new.tick_exactly_once()
    assert calls == ["setup new", "drive 2 at 1.0"]


def test_changed_code_is_made_again_and_takes_over(calls):
    old = running(f'<Sequence _bts_id="s">{drive()}</Sequence>', ticks=3)
    new = Swap(old, tree_of(f'<Sequence _bts_id="s">{drive()}</Sequence>', Drive=Changed)).run()
    assert calls == ["setup drive", "terminate drive INVALID", "shutdown drive"]
    new.tick_exactly_once()
    assert calls[-2:] == ["initialise drive", "drive 104 at 1.0"]


@pytest.mark.parametrize(("code", "reason"), [(Refusing, "not from 2"), (Unready, "no camera")])
def test_the_old_tree_continues_if_new_code_raises(calls, code, reason):
    old = running(drive(), ticks=2)
    swap = Swap(old, tree_of(drive(), Drive=code))
    with pytest.raises(TickError, match=reason):
        swap.run()
    calls.clear()
    old.tick_exactly_once()
    assert calls == ["drive 3 at 1.0"]


def test_an_entry_of_another_type_is_named_and_nothing_happens(calls):
    old = running(drive())
    swap = Swap(
        old, tree_of('<Sequence _bts_id="s"><Text _bts_id="t" ticks="{ticks}"/></Sequence>', Text=Text)
    )
    with pytest.raises(SwapRefusedError, match="'ticks' holds a whole number and would hold a text"):
        swap.run()
    old.tick_exactly_once()
    assert calls == ["drive 2 at 1.0"]


class Text(Drive):
    """An action with a port of another type."""

    OUTPUT_PORTS: ClassVar = {"ticks": Port(str)}


def test_a_comparison_changes_nothing(calls):
    old = running(drive(), ticks=2)
    Swap(old, tree_of('<AlwaysSuccess _bts_id="a"/>'))
    old.tick_exactly_once()
    assert calls == ["drive 3 at 1.0"]


def test_a_delay_ends_when_it_would_have_ended():
    clock = ManualClock()
    delay = '<Delay _bts_id="w" delay_msec="{msec}"><AlwaysSuccess _bts_id="a"/></Delay>'
    old = running(delay.replace("{msec}", "1000"), clock)
    clock.advance(0.6)
    new = Swap(old, tree_of(delay.replace("{msec}", "5000"))).run()
    assert new.tick_exactly_once() is Status.RUNNING
    clock.advance(0.5)
    assert new.tick_exactly_once() is Status.SUCCESS


def test_a_timer_of_a_users_control_node_fires_in_the_new_tree(calls):
    clock = ManualClock()
    body = f'<Pause _bts_id="p">{drive()}</Pause>'
    old = running(body, clock)
    new = Swap(old, tree_of(body)).run()
    clock.advance(1.0)
    new.tick_exactly_once()
    assert calls == ["initialise drive", "drive 1 at 1.0"]


class Early(py_trees.behaviour.Behaviour):
    """Keeps the text of a port from its constructor, as older actions do."""

    OUTPUT_PORTS: ClassVar = {"out": Port(int)}

    def __init__(self, name: str, ports: Any) -> None:
        super().__init__(name)
        self.out = ports["out"]

    def update(self) -> PyTreesStatus:
        tree_tools.set_port_content(self.out, 7)
        return PyTreesStatus.RUNNING


def test_a_port_that_was_read_too_early_leads_to_the_new_blackboard_and_is_named():
    old = tree_of('<Early _bts_id="e" out="{a}"/>', Early=Early)
    old.setup()
    old.tick_exactly_once()
    swap = Swap(old, tree_of('<Early _bts_id="e" out="{b}"/>', Early=Early))
    assert [(late.path, late.port) for late in swap.plan.late_ports] == [("Early::1", "out")]
    new = swap.run()
    new.blackboard["a"] = 0
    new.tick_exactly_once()
    assert new.blackboard["a"] == 7


def test_entries_outlive_a_swap_and_changed_constants_win():
    def body(constant: str) -> str:
        return (
            '<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">'
            f'<SubTree ID="Inner" _bts_id="i" limit="{constant}"/></BehaviorTree><BehaviorTree ID="Inner">'
            '<Script _bts_id="c" code="count += 1; limit += 1"/></BehaviorTree></root>'
        )

    old = Tree.from_xml(body("5"))
    inner = old.boards[1]
    inner["count"] = 1.0
    old.tick_exactly_once()
    same = Swap(old, Tree.from_xml(body("5"))).run().boards[1]
    assert dict(same) == {"limit": 6, "count": 2.0}


def test_a_changed_constant_of_a_subtree_wins():
    def body(constant: str) -> str:
        return (
            '<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">'
            f'<SubTree ID="Inner" _bts_id="i" limit="{constant}"/></BehaviorTree><BehaviorTree ID="Inner">'
            '<Script _bts_id="c" code="count := limit"/></BehaviorTree></root>'
        )

    old = Tree.from_xml(body("5"))
    old.tick_exactly_once()
    new = Swap(old, Tree.from_xml(body("8"))).run()
    assert dict(new.boards[1]) == {"limit": 8, "count": 5.0}


def test_an_equal_tree_takes_over_as_if_nothing_had_happened():
    swaps = 0
    for letters in (USUAL, RARE):
        swaps += sum(compare(case, letters) for case in cases(1, count("engine_swaps")))
    assert swaps > count("engine_swaps")


def test_what_happens_after_the_comparison_is_taken_over_too():
    old = running(drive(), ticks=0)
    swap = Swap(old, tree_of(drive()))
    old.blackboard["found"] = "box"
    assert old.tick_exactly_once() is Status.RUNNING
    old.blackboard["found"] = "ball"
    new = swap.run()
    assert new.root.status.name == "RUNNING"
    assert new.tick_number == 1
    assert (new.blackboard["found"], new.blackboard["ticks"]) == ("ball", 1)


def test_what_an_action_writes_at_its_setup_is_taken_over():
    class Writing(Drive):
        def setup(self, **_: Any) -> None:
            old.blackboard["ready"] = True

    old = running(f'<Sequence _bts_id="s">{drive()}</Sequence>')
    new = Swap(old, tree_of(f'<Sequence _bts_id="s">{drive()}<Writing/></Sequence>', Writing=Writing)).run()
    assert new.blackboard["ready"] is True
    assert new.root.status.name == "RUNNING"
