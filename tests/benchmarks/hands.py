"""Gestures on the canvas, one step of the mouse at a time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from playwright.sync_api import Locator, Page

    # A gesture stops after each step, so that the measuring code can wait for a frame and measure it.
    Gesture = Callable[[Page, Locator, int], Iterator[None]]

SETTLED_MS = 600


def pan(page: Page, canvas: Locator, steps: int) -> Iterator[None]:
    """Moves the tree with the wheel, back and forth."""
    box = canvas.bounding_box()
    assert box
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 60)
    page.wait_for_timeout(SETTLED_MS)
    for step in range(steps):
        way = 1 if step % 40 < 20 else -1
        page.mouse.wheel(24 * way, 6 * way)
        yield


def drag(page: Page, canvas: Locator, steps: int) -> Iterator[None]:
    """Drags a leaf over its siblings, and drops it at its old place."""
    x, y = leaf_of(canvas)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 8, y + 4)
    page.wait_for_timeout(SETTLED_MS)
    for step in range(1, steps + 1):
        angle = 2 * math.pi * step / steps
        page.mouse.move(x + 8 + 70 * math.sin(angle), y + 4 + 30 * (1 - math.cos(angle)))
        yield
    page.mouse.move(x, y)
    page.mouse.up()
    page.wait_for_timeout(SETTLED_MS)


# Answers once the block that is let go has been painted at its new place, with the ms since it was let go.
DROPPED = """(canvas, id) => {
  const at = () => canvas.querySelector(`.react-flow__node[data-id="${id}"]`);
  const before = at().style.transform;
  window.dropped = new Promise((done) => {
    const listening = { capture: true, once: true };
    const onUp = (event) => {
      const look = () => {
        const { transform, translate } = at()?.style ?? { transform: before };
        if (transform === before || translate) return requestAnimationFrame(look);
        // What is sent to oneself in a frame arrives after its paint.
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => done(performance.now() - event.timeStamp);
        port2.postMessage(null);
      };
      requestAnimationFrame(look);
    };
    window.addEventListener('pointerup', onUp, listening);
  });
}"""


# The leaf nearest to the middle of the canvas and its next sibling to the right: id and place of each.
NEIGHBOURS = """(canvas) => {
  const all = canvas.getBoundingClientRect();
  const leaves = [...canvas.querySelectorAll('[data-type=Forward]')].map((leaf) => {
    const { x, y, width, height } = leaf.getBoundingClientRect();
    const far = Math.hypot(x + width / 2 - all.x - all.width / 2, y + height / 2 - all.y - all.height / 2);
    const { id } = leaf.closest('.react-flow__node').dataset;
    return { id, x: x + width / 2, y: y + height / 2, width, far };
  });
  const next = (leaf) =>
    leaves.find((other) => other.y === leaf.y && other.x > leaf.x && other.x - leaf.x < 1.25 * leaf.width);
  const pairs = leaves.map((leaf) => [leaf, next(leaf)]).filter(([, right]) => right);
  return pairs.sort(([a, b], [c, d]) => a.far + b.far - c.far - d.far)[0];
}"""


def drop(page: Page, canvas: Locator) -> Iterator[str]:
    """Takes a leaf beyond its sibling, and back; yields while it is held, and when it is let go."""
    page.wait_for_timeout(SETTLED_MS)
    leaf, sibling = canvas.evaluate(NEIGHBOURS)
    for way in (1, -1):
        held, over = (middle_of(canvas, each["id"]) for each in (leaf, sibling))
        to = (over[0] + way * 0.4 * sibling["width"], over[1])
        page.mouse.move(*held)
        page.mouse.down()
        page.mouse.move(*to, steps=8)
        page.get_by_test_id("insertion-mark").wait_for()
        canvas.evaluate(DROPPED, leaf["id"])
        page.wait_for_timeout(SETTLED_MS)
        yield "held"
        page.mouse.up()
        page.wait_for_timeout(SETTLED_MS)
        yield "dropped"


def middle_of(canvas: Locator, block: str) -> tuple[float, float]:
    """The middle of a block, in px of the window."""
    box = canvas.locator(f'.react-flow__node[data-id="{block}"]').bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def leaf_of(canvas: Locator) -> tuple[float, float]:
    """Returns the middle of the leaf that is nearest to the middle of the canvas, and under no tool."""
    x, y = canvas.evaluate(
        """(canvas) => {
          const middle = (element) => {
            const { x, y, width, height } = element.getBoundingClientRect();
            return [x + width / 2, y + height / 2];
          };
          const [x, y] = middle(canvas);
          const far = ([a, b]) => Math.hypot(a - x, b - y);
          const isInReach = (leaf) => leaf.contains(document.elementFromPoint(...middle(leaf)));
          const leaves = [...canvas.querySelectorAll('[data-type=Forward]')].filter(isInReach).map(middle);
          return leaves.sort((a, b) => far(a) - far(b))[0];
        }"""
    )
    return x, y


def read_at_full_size(page: Page, canvas: Locator) -> None:
    """Shows a leaf at a readable size."""
    page.mouse.click(*leaf_of(canvas))
    page.get_by_role("button", name="Zoom to the selection").click()
    page.wait_for_timeout(SETTLED_MS)


def use_keys(page: Page, canvas: Locator) -> Iterator[str]:
    """Selects, walks, adds, edits and removes; yields the name of each step once it is drawn."""
    page.mouse.click(*leaf_of(canvas))
    yield "select"
    for key, name in (
        ("ArrowLeft", "walk"),
        ("ArrowUp", "walk"),
        ("Tab", "quick add"),
        ("s", "search a block"),
        ("Escape", "close it"),
        ("Control+d", "duplicate"),
        ("Control+z", "undo"),
        ("ArrowDown", "walk"),
        ("Control+ArrowRight", "move"),
        ("Control+z", "undo"),
        ("Delete", "delete"),
        ("Control+z", "undo"),
    ):
        page.keyboard.press(key)
        page.wait_for_timeout(SETTLED_MS)
        yield name
    page.get_by_test_id("port-lin_speed").press("5")
    page.wait_for_timeout(SETTLED_MS)
    yield "type in a port"
