"""The IDE as its user operates it: visible elements, by the names of the page's test ids."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from playwright.sync_api import expect

from tests.deadline import DEADLINE_S
from tests.e2e.observer import Observer
from tests.e2e.server import RARELY_S, wait_until

if TYPE_CHECKING:
    from playwright.sync_api import ConsoleMessage, Locator, Page, Response

    from tests.e2e.server import Server

# The limit of the page for a click, a fill or an expectation.
WAIT_MSEC = DEADLINE_S * 1000
OUTPUT = Path(__file__).parent / "output"
# The canvas has its whole width: a lesson opens in the walks that ask for it.
NO_LESSONS = (
    """localStorage.getItem("bts.lessons") ?? localStorage.setItem("bts.lessons", '{"opens":false}')"""
)
# Nothing points at the canvas: the first task is a walk of its own.
NO_FIRST_TASK = """localStorage.getItem("bts.guide") ?? localStorage.setItem("bts.guide", "done")"""
# The page shows a refused or lost request; the browser's own note of it is not an error of the page.
EXPECTED_NOTES = re.compile(
    r"Failed to load resource|WebSocket connection to .* failed|GPU stall|GL Driver Message"
)
# Every panel and button is there; another walk tests the basic page.
EVERYTHING = """localStorage.getItem("bts.view") ?? localStorage.setItem("bts.view", "full")"""
# The one refusal of normal use: a file was saved elsewhere meanwhile, and is merged.
STALE_SAVE = r"409 POST /api/v1/projects/[^/]+/changes"
# Run, of a project with errors: for walks about them.
NOT_RUNNABLE = r"422 GET /api/v1/projects/[^/]+/app"


class Studio:
    """One page of the IDE."""

    def __init__(
        self,
        page: Page,
        server: Server,
        *,
        keeps_3d: bool = True,
        is_guided: bool = False,
        is_basic: bool = False,
    ) -> None:
        self.page = page
        self.server = server
        self.complaints: list[str] = []
        page.context.set_default_timeout(WAIT_MSEC)
        if keeps_3d:
            # The processor draws WebGL here, slower than 3D that a user would keep.
            page.context.add_init_script("localStorage.setItem('bts.keep3d', 'yes')")
        self.refusals = [STALE_SAVE]
        page.add_init_script(NO_LESSONS)
        if not is_basic:
            page.add_init_script(EVERYTHING)
        if not is_guided:
            page.add_init_script(NO_FIRST_TASK)
        page.on("console", self._note)
        page.on("response", self._hear)
        page.on("pageerror", lambda error: self.complaints.append(str(error)))

    def _note(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning") and not EXPECTED_NOTES.search(message.text):
            self.complaints.append(f"{message.type}: {message.text}")

    def _hear(self, response: Response) -> None:
        refused = f"{response.status} {response.request.method} {urlsplit(response.url).path}"
        if 400 <= response.status < 500 and not re.fullmatch("|".join(self.refusals), refused):
            self.complaints.append(f"refused: {refused}")

    def may_be_refused(self, *patterns: str) -> None:
        """Allows refusals in a walk whose subject is wrong input: `422 POST /api/v1/projects/import`."""
        self.refusals += patterns

    def open(self) -> None:
        """Follows the link with the token to the start page."""
        self.page.goto(self.server.url)
        expect(self.page.get_by_test_id("projects")).to_be_attached()
        expect(self.page.get_by_test_id("fold-templates")).to_be_visible()

    def menu(self, name: str) -> Locator:
        """Returns the open menu of a button by the button's name: another one may still fade away."""
        return self.page.get_by_role("menu", name=name, exact=True)

    def choose(self, menu: str, name: str) -> None:
        """Chooses an item in a menu that is marked for it."""
        self.at(menu).click()
        self.page.get_by_role("menuitemradio", name=name, exact=True).click()

    def new_from(self, template: str) -> None:
        """Makes a project from a template and waits for its tree on the canvas."""
        fold = self.at("fold-templates")
        card = self.at(f"new-from-{template}")
        # They fold once the list of projects has come.
        expect(self.page.locator("[data-testid=fold-templates][aria-busy=false]")).to_be_visible()
        if fold.get_attribute("aria-expanded") == "false" and not card.is_visible():
            fold.click()
        card.click()
        expect(self.at("canvas")).to_be_visible()
        expect(self.at("node-n1")).to_be_visible()

    def at(self, test_id: str) -> Locator:
        """Returns an element by its test id."""
        return self.page.get_by_test_id(test_id)

    def run(self) -> None:
        """Presses Run and waits until the application runs; a running one has started again."""
        state = self.at("executor-state").get_attribute("data-state")
        before = self.stat("t") if state == "application_running" else math.inf
        self.at("run").click()
        self.expect_state("application_running")
        if math.isfinite(before):
            wait_until(lambda: self.stat("t") < before, "the world begins again")

    def expect_state(self, state: str) -> None:
        """Waits for a rung of the ladder; a failure says what the page tells of the run."""
        try:
            expect(self.at("executor-state")).to_have_attribute("data-state", state)
        except AssertionError as error:
            strip = " ".join(self.at("run-strip").all_inner_texts())
            raise AssertionError(f"not {state}; the page says: {strip}") from error

    def saved(self) -> None:
        """Waits until everything typed is stored."""
        expect(self.at("save-state")).to_have_attribute("data-state", "saved")

    def command(self, words: str) -> None:
        """Finds a command by words of its name, and runs it."""
        self._type_command(self.page, words)
        self.page.keyboard.press("Enter")
        expect(self.at("command-palette")).to_have_count(0)

    def command_in_window(self, window: Page, words: str) -> None:
        """As `command`, in the window of a panel; the page's own palette stays closed."""
        self._type_command(window, words)
        expect(self.at("command-palette")).to_have_count(0)
        window.keyboard.press("Enter")

    def pop_out(self, panel: str) -> Page:
        """Opens a panel in a window of its own, by its command."""
        self._type_command(self.page, f"{panel} in a")
        with self.page.expect_popup() as opened:
            self.page.keyboard.press("Enter")
        return opened.value

    def _type_command(self, window: Page, words: str) -> None:
        window.keyboard.press("Control+k")
        palette = window.get_by_test_id("command-palette")
        expect(palette.get_by_role("combobox")).to_be_focused()
        window.keyboard.type(words)
        # Some commands join the list late: the templates of a page that still loads.
        expect(palette.get_by_role("option", selected=True, disabled=False)).to_have_count(1)

    def writing(self) -> None:
        """Waits until typed text goes into a field."""
        expect(self.page.locator("input:focus, textarea:focus")).to_have_count(1)

    def set_port(self, node: str, port: str, value: str) -> None:
        """Selects a node and types a port's value in the inspector."""
        self.at(f"node-{node}").click()
        field = self.at(f"port-{port}")
        field.fill(value)
        field.press("Enter")
        self.saved()

    def open_file(self, path: str) -> None:
        """Opens a file of the project in the editor."""
        self.at(f"file-{path}").click()
        expect(self.at("code-editor")).to_be_visible()

    def replace_code(self, source: str) -> None:
        """Replaces the open file's whole text by typing."""
        editor = self.at("code-editor").locator(".cm-content")
        editor.click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(source)
        self.saved()

    def status(self, node: str) -> str:
        """Returns the status that a block shows."""
        return self.at(f"node-{node}").get_attribute("data-status") or ""

    def statuses_seen(self, node: str, seconds: float) -> set[str]:
        """Returns every status that a block shows within some seconds."""
        seen: set[str] = set()
        for _ in range(int(seconds * 20)):
            seen.add(self.status(node))
            self.page.wait_for_timeout(50)  # the pace is the test: what shows in these seconds is collected
        return seen

    def stat(self, name: str) -> float:
        """Returns a figure of the status bar: speed, distance, collisions, t."""
        return float(self.at("sim-stats").get_attribute(f"data-{name}") or "nan")

    def observe(self) -> Observer:
        """Joins the project's session as a second client, with this browser's cookie."""
        project = self.page.url.split("?")[0].rstrip("/").split("/")[-1]
        session = self.page.evaluate(
            "project => fetch(`/api/v1/projects/${project}/session`, {method: 'POST'}).then(r => r.json())",
            project,
        )
        cookie = "; ".join(f"{c['name']}={c['value']}" for c in self.page.context.cookies())
        return Observer.join(self.server.origin, cookie, session["id"])

    def end_session(self) -> None:
        """Closes the session and waits until none of its processes is left."""
        if self.at("end-session").count():
            self.at("end-session").click()
        else:  # the basic page has it in a menu
            self.command("End the session")
        wait_until(lambda: not self.server.children(), "the session's processes end", every_s=RARELY_S)

    def picture(self, name: str) -> None:
        """Stores a picture of the page, for the docs and for inspection."""
        OUTPUT.mkdir(exist_ok=True)
        self.page.screenshot(path=OUTPUT / f"{name}.png")
