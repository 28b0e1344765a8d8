"""Control nodes and decorators of users: what `update` may do, and the effect of each result."""

from __future__ import annotations

import enum
import re
from pathlib import Path
from typing import Any, ClassVar

import pytest

from tests.tree_gardener.trees import load, recording
from translator import inspect_action
from tree_gardener import LoadError, ManualClock, Port, Status, TickError
from tree_gardener.actions import load_actions
from tree_gardener.control_node import ControlNode, DecoratorNode, LoopNode
from tree_gardener.values import SharedQueue

R, S, F, K = Status.RUNNING, Status.SUCCESS, Status.FAILURE, Status.SKIPPED


def control(update: Any, base: Any = ControlNode, **more: Any) -> Any:
    """A class whose `update` is this function."""
    return type("Own", (base,), {"update": update, **more})


def own(tree: Any, path: str = "own") -> Any:
    """The user's object of a node."""
    return next(node.instance_behaviour for node in tree.nodes if node.path == path)


def letters(tree: Any) -> str:
    return "".join(node.status.letter for node in tree.nodes)


def first_child(self: Any) -> Status:
    result: Status = self.tick_child(0)
    return result


@pytest.mark.parametrize(("result", "after"), [(S, "IS"), (F, "IF"), (R, "RR"), (K, "II")])
def test_a_control_takes_the_result_and_resets_nothing(result: Status, after: str) -> None:
    tree = load('<Own name="own"><A/></Own>', nodes={"Own": control(first_child), "A": recording(result)})
    assert tree.tick_exactly_once() is result
    assert letters(tree) == after  # the root's own result is reset by the tree


@pytest.mark.parametrize(("result", "after"), [(S, "SI"), (F, "FI"), (R, "RR"), (K, "II")])
def test_a_decorator_resets_a_child_that_is_done(result: Status, after: str) -> None:
    nodes = {"Own": control(first_child, DecoratorNode), "A": recording(result)}
    tree = load('<SequenceWithMemory><Own name="own"><A/></Own><Running/></SequenceWithMemory>', nodes=nodes)
    tree.tick_exactly_once()
    assert letters(tree)[1:3] == (after if result is not F else "II")


def test_marks_running_makes_it_running_before_update_and_a_skip_leaves_it_so() -> None:
    seen = []

    def update(self: Any) -> Status:
        seen.append(self.status)
        return K

    for marks in (False, True):
        tree = load("<Own><Running/></Own>", nodes={"Own": control(update, MARKS_RUNNING=marks)})
        assert tree.tick_exactly_once() is K
        assert tree.nodes[0].status is seen[-1]
    assert seen == [Status.IDLE, R]


def test_mark_running_does_it_later() -> None:
    def update(self: Any) -> Status:
        before = self.status
        self.mark_running()
        return K if before is Status.IDLE else self.status

    tree = load("<Own><Running/></Own>", nodes={"Own": control(update)})
    assert [tree.tick_exactly_once(), tree.tick_exactly_once()] == [K, R]


def test_a_child_may_be_ticked_again_in_one_tick_and_rests_until_it_is_reset() -> None:
    def update(self: Any) -> Status:
        results = [self.tick_child(0), self.tick_child(0)]
        self.halt_child(0)
        results.append(self.tick_child(0))
        self.results = results
        return S

    tree = load('<Own name="own"><A/></Own>', nodes={"Own": control(update), "A": recording(S, F)})
    tree.tick_exactly_once()
    assert own(tree).results == [S, S, F]
    assert tree.nodes[1].behaviour.calls.count("update") == 2


def test_halting_runs_the_script_only_of_a_running_child_and_makes_all_idle() -> None:
    def update(self: Any) -> Status:
        self.results = [self.tick_child(index) for index in range(self.child_count)]
        self.halt_children(1)
        self.kept = [self.child_status(index) for index in range(self.child_count)]
        self.reset_children()
        return R

    body = "".join(f'<{kind} _onHalted="{kind} := 1"/>' for kind in ("Running", "Running", "Succeeding"))
    tree = load(f'<Own name="own">{body}</Own>', nodes={"Own": control(update)})
    tree.tick_exactly_once()
    assert own(tree).results == [R, R, S]
    assert own(tree).kept == [R, Status.IDLE, Status.IDLE]
    assert letters(tree) == "RIII"
    assert set(tree.blackboard.entries) == {"Running"}


def test_the_nodes_own_conditions_are_evaluated_round_update() -> None:
    calls = []

    def update(self: Any) -> Status:
        calls.append(self.status)
        return S

    conditions = '_skipIf="x == 1" _failureIf="x == 2" _onSuccess="y := 1" _onFailure="y := 2" _post="z := y"'
    tree = load(f"<Own {conditions}><Running/></Own>", nodes={"Own": control(update)})
    expected = {0: (S, 1), 1: (K, 1), 2: (F, 2)}
    for value, (result, y) in expected.items():
        tree.blackboard["x"] = value
        assert tree.tick_exactly_once() is result
        assert (tree.blackboard["y"], tree.blackboard["z"]) == (y, y)
    assert len(calls) == 1


def test_ports_clock_wake_up_and_setup() -> None:
    clock = ManualClock(5.0)

    class Own(ControlNode):
        INPUT_PORTS: ClassVar = {"speed": Port(float, default=0.5)}
        OUTPUT_PORTS: ClassVar = {"out": Port(float)}
        calls = 0

        def setup(self, **kwargs: Any) -> None:
            self.given = kwargs

        def update(self) -> Status:
            self.calls += 1
            self.set_output("out", self.get_input("speed") + self.now())
            if self.calls == 1:
                self.emit_wake_up()
            return R

        def shutdown(self) -> None:
            self.given = {}

    tree = load('<Own name="own" out="{o}"><Running/></Own>', nodes={"Own": Own}, clock=clock)
    tree.setup(node="ros")
    assert own(tree).given == {"node": "ros"}
    tree.tick_once()
    assert own(tree).calls == 2
    assert tree.blackboard["o"] == 5.5
    tree.shutdown()
    assert own(tree).given == {}


def test_a_timer_of_the_trees_clock_may_halt_a_child_and_not_tick_one() -> None:
    clock = ManualClock()

    class Own(DecoratorNode):
        def update(self) -> Status:
            if self.status is Status.IDLE:
                self.timer = self.start_timer(1.0, self.end)
            return self.tick_child()

        def end(self) -> None:
            self.halt_child()
            self.emit_wake_up()
            with pytest.raises(TickError, match="outside of its own tick"):
                self.tick_child()

        def halt(self) -> None:
            self.timer.cancel()

    tree = load('<Own name="own"><A/></Own>', nodes={"Own": Own, "A": recording(R)}, clock=clock)
    tree.tick_exactly_once()
    clock.advance(1.0)
    tree.fire_timers()
    assert letters(tree) == "RI"
    assert tree.wake_up
    tree.tick_exactly_once()
    tree.halt()
    assert tree.timers.next_s() is None


def test_a_halt_override_comes_first_and_what_it_raises_is_reported_and_stops_nothing() -> None:
    class Own(ControlNode):
        def update(self) -> Status:
            return self.tick_child(0)

        def halt(self) -> None:
            self.seen = (*getattr(self, "seen", ()), self.child_status(0))
            raise ValueError("cannot stop")

    tree = load('<Own name="own"><A name="a"/></Own>', nodes={"Own": Own, "A": recording(R)})
    said: list[str] = []
    tree.on_warning = lambda node, text: said.append(f"{node.path}: {text}")
    tree.tick_exactly_once()
    tree.halt()
    assert own(tree).seen == (R, Status.IDLE), "haltTree halts every node once more"
    assert letters(tree) == "II"
    [text] = said
    line = Own.halt.__code__.co_firstlineno + 2
    assert text.startswith("own: halt() raised ValueError: cannot stop at ")
    assert text.endswith(f"test_control_node.py:{line}")
    assert tree.nodes[1].behaviour.calls[-1] == "terminate INVALID from RUNNING"


def test_halting_itself_within_update_starts_again_from_nothing() -> None:
    class Own(ControlNode):
        MARKS_RUNNING = True

        def update(self) -> Status:
            self.tick_child(0)
            self.halt()
            return K

    tree = load("<Own><Running/></Own>", nodes={"Own": Own})
    assert tree.tick_exactly_once() is K
    assert letters(tree) == "II"


def test_done_with_a_child_running_is_allowed_and_said_once() -> None:
    def update(self: Any) -> Status:
        self.tick_child(0)
        return S

    tree = load("<Own><Running/></Own>", nodes={"Own": control(update)})
    said: list[str] = []
    tree.on_warning = lambda node, text: said.append(text)
    assert [tree.tick_exactly_once(), tree.tick_exactly_once()] == [S, S]
    assert letters(tree) == "IR"
    assert len(said) == 1
    assert "while its child 'Running::2' is RUNNING" in said[0]


@pytest.mark.parametrize(
    ("changes", "body", "code"),
    [
        ({"MIN_CHILDREN": 2}, "<Running/>", "TG210"),
        ({"MAX_CHILDREN": 1}, "<Running/><Running/>", "TG225"),
        ({}, "", "TG210"),
        ({"MIN_CHILDREN": 0}, "<Running/>", "TG602"),
        ({"MIN_CHILDREN": 3, "MAX_CHILDREN": 2}, "<Running/>", "TG602"),
        ({"MAX_CHILDREN": "many"}, "<Running/>", "TG602"),
    ],
)
def test_the_number_of_children_is_checked_at_load(changes: dict[str, Any], body: str, code: str) -> None:
    with pytest.raises(LoadError) as refused:
        load(f"<Own>{body}</Own>", nodes={"Own": control(first_child, **changes)})
    assert [problem.code for problem in refused.value.diagnostics] == [code]


def test_a_decorator_has_one_child() -> None:
    own_class = control(first_child, DecoratorNode)
    for body in ("", "<Running/><Running/>"):
        with pytest.raises(LoadError, match="needs exactly 1"):
            load(f"<Own>{body}</Own>", nodes={"Own": own_class})
    with pytest.raises(LoadError, match="leave out MIN_CHILDREN"):
        load("<Own><Running/></Own>", nodes={"Own": control(first_child, DecoratorNode, MAX_CHILDREN=2)})


def test_a_constructor_that_asks_too_early_is_refused_with_the_reason() -> None:
    def construct(self: Any, name: str) -> None:
        ControlNode.__init__(self, name)
        self.count = self.child_count

    with pytest.raises(LoadError, match="in no tree yet"):
        load("<Own><Running/></Own>", nodes={"Own": control(first_child, __init__=construct)})


class Pose:
    """Something that is no text."""


class Way(enum.Enum):
    LEFT = 1
    RIGHT = 2


def loop(element: Any) -> Any:
    return type("Each", (LoopNode,), {"ELEMENT": element})


def test_a_loop_takes_elements_of_any_class_from_a_shared_queue() -> None:
    seen: list[Any] = []

    class Note(ControlNode):
        INPUT_PORTS: ClassVar = {"pose": Port(Pose)}

        def update(self) -> Status:
            seen.append(self.get_input("pose"))
            return S

    poses = [Pose(), Pose()]
    body = '<Each queue="{poses}" value="{pose}"><Note pose="{pose}"><Running/></Note></Each>'
    tree = load(body, nodes={"Each": loop(Pose), "Note": Note})
    tree.blackboard["poses"] = queue = SharedQueue[Pose](poses)
    assert [tree.tick_exactly_once() for _ in range(3)] == [R, R, S]
    assert seen == poses
    assert not queue


@pytest.mark.parametrize(
    ("element", "text", "values"),
    [(int, "1;2", [1, 2]), (Way, "LEFT;2", [Way.LEFT, Way.RIGHT]), (Any, "a;b", ["a", "b"])],
)
def test_a_loop_reads_literals_where_its_elements_have_them(
    element: Any, text: str, values: list[Any]
) -> None:
    tree = load(f'<Each queue="{text}" value="{{x}}"><Succeeding/></Each>', nodes={"Each": loop(element)})
    found = []
    for _ in values:
        assert tree.tick_exactly_once() is R
        found.append(tree.blackboard["x"])
    assert found == values
    assert tree.tick_exactly_once() is S


def test_a_loop_refuses_an_element_of_another_class_and_a_literal_of_a_class() -> None:
    tree = load('<Each queue="{q}" value="{x}"><Running/></Each>', nodes={"Each": loop(Pose)})
    tree.blackboard["q"] = SharedQueue(["text"])
    with pytest.raises(TickError, match="not a Pose"):
        tree.tick_exactly_once()
    with pytest.raises(LoadError, match="cannot be written as text"):
        load('<Each queue="1;2" value="{x}"><Running/></Each>', nodes={"Each": loop(Pose)})
    with pytest.raises(LoadError, match="needs a value"):
        load('<Each value="{x}"><Running/></Each>', nodes={"Each": loop(Pose)})


def test_a_queue_may_be_declared_by_the_action_that_fills_it() -> None:
    class Fill(ControlNode):
        OUTPUT_PORTS: ClassVar = {"queue": Port(SharedQueue[Pose])}

        def update(self) -> Status:
            self.set_output("queue", SharedQueue[Pose]([Pose()]))
            return S

    fill, each = '<Fill queue="{q}"><Running/></Fill>', '<Each queue="{q}" value="{x}"><Succeeding/></Each>'
    body = f"<Sequence>{fill}{each}</Sequence>"
    tree = load(body, nodes={"Fill": Fill, "Each": loop(Pose)})
    assert tree.tick_exactly_once() is R
    assert isinstance(tree.blackboard["x"], Pose)


PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "write-a-control-node.md"


def test_the_examples_of_the_page_are_sound_and_run() -> None:
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    sources = {
        match.group(1): block for block in blocks if (match := re.search(r"^class (\w+)", block, re.M))
    }
    assert set(sources) == {"FirstOf", "AtMostEvery", "LoopPose", "Prefer"}
    for name, source in sources.items():
        assert inspect_action(source, f"actions/{name}.py").diagnostics == ()
    nodes = load_actions({name: source for name, source in sources.items() if name != "LoopPose"})
    assert load("<FirstOf><Failing/><Succeeding/></FirstOf>", nodes=nodes).tick_once() is S
    assert load('<FirstOf limit="1"><Failing/><Succeeding/></FirstOf>', nodes=nodes).tick_once() is F
    assert load("<Prefer><Failing/><Running/></Prefer>", nodes=nodes).tick_once() is R
    tree = load("<AtMostEvery><Succeeding/></AtMostEvery>", nodes=nodes, clock=ManualClock())
    assert [tree.tick_once(), tree.tick_once()] == [S, K]
