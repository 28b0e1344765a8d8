"""An executor that is alive and does not answer: the page reports it, and the next Run works."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import psutil
import pytest
from playwright.sync_api import expect

from tests.e2e.server import DEADLINE_S, serving, wait_until
from tests.e2e.studio import Studio
from tests.processes import with_word

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

    from tests.e2e.server import Server

pytestmark = pytest.mark.kills


def manager_of(server: Server) -> psutil.Process:
    """Returns the manager of the only running session."""
    (manager,) = with_word("executor.manager", server.process.children())
    return manager


def test_a_frozen_executor_is_shown_then_ended_and_run_starts_another(
    tmp_path: Path, browser_without_webgl: Browser
) -> None:
    # A busy machine delays the page, and without a GPU the 3D view blocks it.
    with serving(tmp_path, BT_STUDIO_SESSION_SILENCE_S="15") as server:
        page = browser_without_webgl.new_context(viewport={"width": 1440, "height": 900}).new_page()
        studio = Studio(page, server)
        # The session that was ended is asked for.
        studio.may_be_refused(r"404 GET /api/v1/sessions/.*")
        studio.open()
        freeze(studio)
        page.context.close()
        assert studio.complaints == [], "the browser's console must stay empty"


def freeze(studio: Studio) -> None:
    """Freezes the executor of a run for a while, then permanently, and runs again."""
    studio.new_from("laser_bump_and_go")
    studio.run()
    first = manager_of(studio.server)
    family = [first, *first.children(recursive=True)]
    banner, state = studio.at("banner"), studio.at("executor-state")

    first.suspend()
    expect(banner).to_have_attribute("data-kind", "silence")
    expect(banner).to_contain_text(re.compile(r"The session has not answered for \d+ s"))
    expect(state).to_have_attribute("data-shown", "silent")
    first.resume()
    expect(banner).to_have_count(0)
    expect(state).to_have_attribute("data-shown", "application_running")
    expect(studio.at("console")).to_contain_text("The session answers again")

    first.suspend()
    studio.at("pause").click()  # a request during the freeze is answered, too
    expect(banner).to_have_attribute("data-kind", "silence")
    studio.picture("silent")
    expect(banner).to_contain_text("The session has ended.")
    expect(banner).to_contain_text("The session stopped answering, so it was ended.")
    _, alive = psutil.wait_procs(family, timeout=DEADLINE_S)
    assert alive == []

    banner.get_by_role("button", name="Run", exact=True).click()
    studio.expect_state("application_running")
    expect(banner).to_have_count(0)
    assert manager_of(studio.server).pid != first.pid
    moved_from = studio.stat("t")
    wait_until(lambda: studio.stat("t") > moved_from, "time passes in the new world")
    studio.end_session()
