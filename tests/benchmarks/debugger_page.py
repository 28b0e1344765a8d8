"""The debugger in Chromium: the time from a stop, a step or *Attach* until the page shows it.

Times begin in the page: when the message of the session arrives, or when the key or button is pressed.
"""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import expect, sync_playwright

from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.server import serving
from tests.e2e.studio import WAIT_MSEC, Studio
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import cpp_program

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.e2e.server import Server

ROUNDS = 15
TYPING_S = 3
CHECK, PYTHON_FILE = "n4", "actions/CheckObstacle.py"
# Notes when a press or a message of the session comes, and when an element is painted for the first time.
WATCH = """() => {
  const notes = (window.benchNotes = {});
  const own = window.WebSocket;
  window.WebSocket = class extends own {
    constructor(...given) {
      super(...given);
      this.addEventListener('message', ({ data }) => {
        if (typeof data !== 'string') return;
        if (data.includes('"command":"held"')) notes.held = performance.now();
        if (data.includes('"command":"dap"') && data.includes('"stopped"')) notes.stopped = performance.now();
      });
    }
  };
  for (const kind of ['keydown', 'pointerdown'])
    window.addEventListener(kind, () => (notes.pressed = performance.now()), { capture: true });
}"""
SHOWN = """(selector) => new Promise((done) => {
  const look = () => {
    if (!document.querySelector(selector)) return requestAnimationFrame(look);
    const { port1, port2 } = new MessageChannel();  // what is sent in a frame arrives after its paint
    port1.onmessage = () => done(performance.now());
    port2.postMessage(null);
  };
  look();
})"""
CHANGED = """([selector, before]) => new Promise((done) => {
  const look = () => {
    const now = document.querySelector(selector)?.textContent;
    if (!now || now === before) return requestAnimationFrame(look);
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => done(performance.now());
    port2.postMessage(null);
  };
  look();
})"""


def main() -> None:
    """Prints every figure."""
    expect.set_options(timeout=WAIT_MSEC)
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder)) as server,
        sync_playwright() as started,
        started.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL]) as browser,
    ):
        studio = opened(browser, server)
        blocks(studio)
        lines(studio)
        studio.end_session()
        studio.page.close()
        for typing_s in (0, TYPING_S):
            attaching(browser, server, typing_s)


def opened(browser: Browser, server: Server) -> Studio:
    """A page whose messages are noted."""
    page = browser.new_page(viewport={"width": 1400, "height": 900})
    page.add_init_script(f"({WATCH})()")
    studio = Studio(page, server)
    studio.open()
    return studio


def since(studio: Studio, note: str, at_ms: float) -> float:
    """The ms from a note until a moment."""
    return at_ms - float(studio.page.evaluate(f"() => window.benchNotes.{note}"))


def shown(studio: Studio, selector: str) -> float:
    """The moment at which an element is painted, in ms."""
    return float(studio.page.evaluate(SHOWN, selector))


def say(what: str, found: list[float], target_ms: int) -> None:
    """Prints a row."""
    middle, worst = statistics.median(found), max(found)
    print(f"{what:46} median {middle:6.0f} ms, largest {worst:6.0f} ms (target {target_ms} ms)", flush=True)


def blocks(studio: Studio) -> None:
    """A breakpoint at a block, and steps."""
    studio.new_from("laser_bump_and_go")
    studio.set_port(CHECK, "obs_dist", "50")
    studio.run()
    expect(studio.at("node-n5")).to_have_attribute("data-status", "RUNNING")
    studio.at(f"node-{CHECK}").click()
    held = f'[data-testid="node-{CHECK}"][data-held="here"]'
    hits, steps = [], []
    studio.at(f"breakpoint-{CHECK}").click()
    shown(studio, held)
    for _ in range(ROUNDS):
        studio.expect_state("held")  # a message of its own; until it comes, the keys have no effect
        before = studio.at("held-banner").inner_text()
        studio.page.keyboard.press("F10")
        at_ms = float(studio.page.evaluate(CHANGED, ["[data-testid=held-banner]", before]))
        steps.append(since(studio, "pressed", at_ms))
        studio.page.evaluate("() => { window.benchNotes.held = Infinity; }")
        studio.page.keyboard.press("F5")
        studio.page.wait_for_function("() => window.benchNotes.held < Infinity")
        hits.append(since(studio, "held", shown(studio, held)))
    say("a hit of a breakpoint until it is shown", hits, 150)
    say("a step, from its key until it is shown", steps, 100)
    studio.page.keyboard.press("F9")
    studio.page.keyboard.press("F5")
    studio.expect_state("application_running")


def lines(studio: Studio) -> None:
    """A stop at a line of Python, until the variables of its frame are there."""
    studio.open_file(PYTHON_FILE)
    studio.page.locator(".cm-line", has_text="if self.scan is None").click()
    studio.page.keyboard.press("F9")
    expect(studio.at("python-banner")).to_contain_text("Held in update", timeout=60_000)
    studio.at("python-values").click()
    shown(studio, "[data-testid=value-self]")
    found = []
    for _ in range(ROUNDS):
        studio.page.evaluate("() => { window.benchNotes.stopped = Infinity; }")
        studio.page.keyboard.press("F5")
        expect(studio.at("value-self")).to_have_count(0)
        at_ms = shown(studio, "[data-testid=value-self]")
        found.append(since(studio, "stopped", at_ms))
    say("a stop in Python until its variables are shown", found, 300)
    studio.page.locator(".cm-line", has_text="if self.scan is None").click()
    studio.page.keyboard.press("F9")
    studio.page.keyboard.press("F5")
    studio.expect_state("application_running")


def attaching(browser: Browser, server: Server, typing_s: int) -> None:
    """*Attach*, from its button until the first block has a status; the dialog is open for `typing_s`."""
    port = free_port()
    found: list[float] = []
    with cpp_program(port):
        for _ in range(5):
            studio = opened(browser, server)
            studio.at("attach").click()
            studio.at("attach-address").fill(f"127.0.0.1:{port}")
            studio.page.wait_for_timeout(1000 * typing_s)  # a user writes the address
            studio.at("attach-accept").click()
            at_ms = shown(studio, '[data-testid^="node-"][data-status="RUNNING"]')
            found.append(since(studio, "pressed", at_ms))
            studio.at("attached-detach").click()
            studio.page.wait_for_timeout(1500)  # the session ends, and the next spare process is warm
            studio.page.close()
    say(f"attach, {typing_s} s after its dialog, until the first picture", found, 500)


if __name__ == "__main__":
    main()
