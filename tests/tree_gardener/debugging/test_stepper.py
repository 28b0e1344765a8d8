import pytest

from tests.tree_gardener.debugging.trees import tree_of
from tree_gardener.debugging import Event, Step
from tree_gardener.debugging.stepper import Shape, Stepper

# 1 Sequence: 2 Inverter: 3 Leaf; 4 Fallback: 5 Leaf, 6 Leaf; 7 Leaf
SHAPE = Shape((7, 7, 3, 3, 6, 5, 6, 7), (0, 0, 1, 2, 1, 4, 4, 1))
BEFORE, AFTER, DECIDED, HALTED = Event.BEFORE, Event.AFTER, Event.DECIDED, Event.HALTED


def test_the_shape_of_a_tree() -> None:
    leaf = '<Leaf name="x.S"/>'
    tree = tree_of(f"<Sequence><Inverter>{leaf}</Inverter><Fallback>{leaf}{leaf}</Fallback>{leaf}</Sequence>")
    assert Shape.of(tree.nodes) == SHAPE
    assert SHAPE.is_below(5, 4)
    assert SHAPE.is_below(5, 1)
    assert not SHAPE.is_below(4, 4)
    assert not SHAPE.is_below(7, 4)


@pytest.mark.parametrize(
    ("step", "at", "goes_on", "ends"),
    [
        (Step.INTO, (BEFORE, 4), [], (BEFORE, 5, 1)),
        (Step.OVER, (BEFORE, 4), [(BEFORE, 5, 1), (AFTER, 5, 1), (HALTED, 6, 1)], (AFTER, 4, 1)),
        (Step.OVER, (BEFORE, 4), [(BEFORE, 5, 1)], (BEFORE, 5, 2)),  # an exception ended the tick
        (Step.OVER, (BEFORE, 4), [], (DECIDED, 4, 1)),
        (Step.OVER, (AFTER, 4), [], (BEFORE, 7, 1)),
        (Step.OUT, (BEFORE, 5), [(AFTER, 5, 1), (BEFORE, 6, 1)], (AFTER, 4, 1)),
        (Step.OUT, (AFTER, 4), [(BEFORE, 7, 1), (AFTER, 7, 1)], (AFTER, 1, 1)),
        (Step.OUT, (BEFORE, 1), [(BEFORE, 2, 1), (AFTER, 7, 1)], (BEFORE, 1, 2)),
        (Step.TICK, (BEFORE, 3), [(AFTER, 3, 1), (AFTER, 1, 1), (HALTED, 3, 2)], (BEFORE, 1, 2)),
        (Step.TO, (BEFORE, 1), [(BEFORE, 6, 1), (BEFORE, 6, 2)], (BEFORE, 7, 2)),
        (Step.CONTINUE, (BEFORE, 3), [(AFTER, 3, 1), (BEFORE, 1, 9)], None),
    ],
)
def test_where_a_step_ends(step: Step, at: tuple[Event, int], goes_on, ends) -> None:
    stepper = Stepper(SHAPE)
    stepper.begin(step, at[0], at[1], 1, 7)
    assert [stepper.reason(*event) for event in goes_on] == [""] * len(goes_on)
    if ends is not None:
        assert stepper.reason(*ends)
    stepper.end()
    assert stepper.reason(BEFORE, 1, 10) == ""


@pytest.mark.parametrize("step", [Step.OVER, Step.OUT])
def test_between_two_ticks_a_step_over_or_out_is_one_tick(step: Step) -> None:
    stepper = Stepper(SHAPE)
    stepper.begin(step, None, 0, tick=4)
    assert stepper.is_stepping
    assert stepper.reason(BEFORE, 1, 5) == "one tick"


def test_a_hold_ends_at_the_next_event() -> None:
    stepper = Stepper(SHAPE)
    stepper.hold()
    assert stepper.reason(HALTED, 6, 1) == "a hold was requested"
