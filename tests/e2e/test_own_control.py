"""A control node and a decorator of your own: made on the canvas, written, run, and found when they fail."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.canvas_by_hand import block, children, rest
from tests.e2e.server import wait_until
from tests.e2e.studio import NOT_RUNNABLE

if TYPE_CHECKING:
    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

ALTERNATE = '''"""A control node."""

from tree_gardener import ControlNode, Port, Status


class Alternate(ControlNode):
    """Ticks its children in turn, one in each tick."""

    MARKS_RUNNING = True
    MIN_CHILDREN = 2
    OUTPUT_PORTS = {"turn": Port(int, default="{turn}", description="The child that was ticked.")}
    turn = -1

    def update(self):
        self.turn = (self.turn + 1) % self.child_count
        self.set_output("turn", self.turn)
        self.tick_child(self.turn)
        return Status.RUNNING
'''
ALTERNATE_PATH = "actions/Alternate.py"
SWAP = '''"""A decorator."""

from tree_gardener import DecoratorNode, Status


class Swap(DecoratorNode):
    """Returns SUCCESS for FAILURE, and FAILURE for SUCCESS."""

    def update(self):
        status = self.tick_child()
        return {Status.SUCCESS: Status.FAILURE, Status.FAILURE: Status.SUCCESS}.get(status, status)
'''


def test_a_control_node_and_a_decorator_are_made_run_and_repaired(studio: Studio) -> None:
    studio.at("new-from-empty").click()
    expect(studio.at("ghost-block")).to_be_visible()
    studio.may_be_refused(NOT_RUNNABLE)
    made_on_the_canvas(studio)
    written(studio, ALTERNATE_PATH, ALTERNATE)
    children_are_given(studio)
    it_runs(studio)
    a_wrong_child_is_named(studio)


def made_on_the_canvas(studio: Studio) -> None:
    """The name of a node that does not exist offers each kind of node."""
    studio.at("canvas").focus()
    studio.page.keyboard.type("Alternate")
    offered = studio.at("quick-add").get_by_text("New control node “Alternate”")
    expect(offered).to_be_visible()
    studio.picture("own-control-offered")
    offered.click()
    expect(block(studio, "Alternate")).to_be_visible()
    expect(studio.at(f"file-{ALTERNATE_PATH}")).to_be_visible()


def written(studio: Studio, path: str, source: str) -> None:
    """Types the source of a node, and returns to the tree."""
    studio.at(f"file-{path}").click()
    editor = studio.page.locator(f'[data-path="{path}"] .cm-content')
    editor.click()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(source)
    studio.saved()
    studio.at("file-trees/MainTree.json").click()
    expect(block(studio, "Alternate")).to_be_visible()


def children_are_given(studio: Studio) -> None:
    """Too few children are an error; the palette lists the node with the built-in ones."""
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text("child")
    search = studio.page.get_by_label("Search nodes")
    search.fill("Alternate")
    expect(studio.at("palette-Alternate")).to_be_visible()
    studio.picture("own-control-palette")
    for type_ in ("AlwaysSuccess", "AlwaysFailure"):
        search.fill(type_)
        rest(block(studio, "Alternate"))  # the view may still move to the last one, or be tidied
        studio.at(f"palette-{type_}").drag_to(block(studio, "Alternate"))
        expect(block(studio, type_)).to_be_visible()
        studio.at("tidy").click()
    search.fill("")
    wait_until(
        lambda: children(studio) == ["Alternate", "AlwaysSuccess", "AlwaysFailure"], "both are its children"
    )
    wrapped_in_a_decorator(studio)


def wrapped_in_a_decorator(studio: Studio) -> None:
    block(studio, "AlwaysFailure").click()
    studio.page.keyboard.press("Control+g")
    studio.writing()
    studio.page.keyboard.type("Swap")
    studio.at("quick-add").get_by_text("New decorator “Swap”").click()
    expect(block(studio, "Swap")).to_be_visible()
    written(studio, "actions/Swap.py", SWAP)
    studio.at("tidy").click()
    wait_until(lambda: children(studio)[1:3] == ["AlwaysSuccess", "Swap"], "the decorator is between")


def it_runs(studio: Studio) -> None:
    """Both children are ticked in turn, and the decorator changes what its child returns."""
    studio.run()
    for type_, status in (
        ("Alternate", "RUNNING"),
        ("AlwaysSuccess", "SUCCESS"),
        ("Swap", "SUCCESS"),
    ):
        expect(block(studio, type_)).to_have_attribute("data-status", status)
    observer = studio.observe()
    wait_until(lambda: turns(observer) == {0, 1}, "each child had its turn")
    observer.close()
    for scheme in ("dark", "light"):
        expect_accessible(studio, scheme)
        studio.picture(f"own-control-runs-{scheme}")


def turns(observer: Observer) -> set[int]:
    """Returns the values that the blackboard had under `turn`."""
    entries = [entry for event in observer.of("blackboard") for entry in event["data"]["entries"]]
    return {entry["value"] for entry in entries if entry["key"] == "turn"}


def a_wrong_child_is_named(studio: Studio) -> None:
    """A control node that ticks a child that it has not: file, line and block are named."""
    bad = ALTERNATE.replace("self.tick_child(self.turn)", "self.tick_child(7)")
    line = bad.splitlines().index("        self.tick_child(7)") + 1
    written(studio, ALTERNATE_PATH, bad)
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text(f"Alternate.py:{line}")
    expect(block(studio, "Alternate")).to_have_attribute("data-fault", "")
    studio.picture("own-control-fault")
    written(studio, ALTERNATE_PATH, ALTERNATE)
    studio.run()
    studio.end_session()
