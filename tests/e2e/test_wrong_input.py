"""Errors are shown at their place, and a second Run works."""

from __future__ import annotations

import re
import socket
import subprocess
from typing import TYPE_CHECKING

import psutil
import pytest
from playwright.sync_api import expect

from tests.e2e.server import command, wait_until
from tests.processes import with_word

if TYPE_CHECKING:
    from pathlib import Path

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

FORWARD = "actions/Forward.py"


def source_of(studio: Studio, path: str) -> str:
    """Returns the stored text of a file of the open project."""
    project = studio.page.url.rstrip("/").split("/")[-1]
    return str(
        studio.page.evaluate(
            "([project, path]) => fetch(`/api/v1/projects/${project}`).then(r => r.json())"
            ".then(p => p.files.find(f => f.path === path).content)",
            [project, path],
        )
    )


def test_faults_are_shown_at_their_place_and_the_next_run_works(studio_without_views: Studio) -> None:
    studio = studio_without_views
    studio.new_from("laser_bump_and_go")
    good = source_of(studio, FORWARD)
    an_unclosed_brace_in_a_port_is_marked_and_stops_the_run(studio)
    a_syntax_error_is_shown_at_its_line_before_anything_runs(studio, good)
    an_action_that_raises_is_named_with_file_and_line(studio, good)
    an_action_that_never_returns_is_detected_and_named(studio, good)
    a_world_that_dies_is_reported_and_the_next_run_works(studio)


def it_runs_again(studio: Studio) -> None:
    studio.run()
    expect(studio.at("banner")).to_have_count(0)


def an_unclosed_brace_in_a_port_is_marked_and_stops_the_run(studio: Studio) -> None:
    studio.set_port("n6", "lin_speed", "{speed")
    expect(studio.at("node-n6")).to_have_attribute("data-problem", "error")
    studio.open_file(FORWARD)
    studio.at("run").click()
    expect(studio.at("problems")).to_contain_text("{speed")
    assert not studio.server.children(), "nothing was started"
    # The run leads from the file to the block, and into the field of its port.
    expect(studio.at("node-n6")).to_have_attribute("data-selected", "true")
    expect(studio.at("port-lin_speed")).to_be_focused()
    expect(studio.at("node-n6")).to_be_in_viewport()
    expect(studio.page.get_by_text("NaN")).to_have_count(0)
    expect(studio.at("banner")).to_contain_text("has a brace without its partner")
    studio.picture("refused-run-light")
    studio.set_port("n6", "lin_speed", "0.3")
    expect(studio.at("node-n6")).not_to_have_attribute("data-problem", "error")


def a_syntax_error_is_shown_at_its_line_before_anything_runs(studio: Studio, good: str) -> None:
    studio.open_file(FORWARD)
    studio.replace_code(good.replace("twist = Twist()", "twist = = Twist()"))
    line = good.splitlines().index("        twist = Twist()") + 1
    studio.at("run").click()
    expect(studio.at("problems")).to_contain_text(f"Forward.py:{line}")
    assert not studio.server.children(), "nothing was started"

    studio.replace_code(good)
    it_runs_again(studio)


def an_action_that_raises_is_named_with_file_and_line(studio: Studio, good: str) -> None:
    bad = good.replace("        self.publisher.publish(twist)", "        self.publisher.publish(twst)")
    line = bad.splitlines().index("        self.publisher.publish(twst)") + 1
    studio.open_file(FORWARD)
    studio.replace_code(bad)
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text("twst")
    expect(studio.at("banner")).to_contain_text(f"Forward.py:{line}")
    studio.page.get_by_role("tab", name=re.compile("MainTree")).or_(
        studio.page.locator(".flexlayout__tab_button", has_text="MainTree")
    ).first.click()
    expect(studio.at("node-n6")).to_have_attribute("data-fault", "")
    studio.picture("fault")

    studio.open_file(FORWARD)
    studio.replace_code(good)
    it_runs_again(studio)


def an_action_that_never_returns_is_detected_and_named(studio: Studio, good: str) -> None:
    bad = good.replace("        twist = Twist()", "        while True: pass\n        twist = Twist()")
    studio.open_file(FORWARD)
    studio.replace_code(bad)
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text("Forward")
    studio.at("stop").click()
    studio.expect_state("visualization_ready")

    studio.open_file(FORWARD)
    studio.replace_code(good)
    it_runs_again(studio)


def a_world_that_dies_is_reported_and_the_next_run_works(studio: Studio) -> None:
    world = with_word("executor.world", studio.server.children())[0]
    psutil.Process(world.pid).kill()
    expect(studio.at("banner")).to_contain_text(re.compile("world", re.IGNORECASE))
    studio.expect_state("connected")
    it_runs_again(studio)
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > 0.1, "the robot moves again")
    observer.close()


def test_a_leaf_without_its_action_is_marked_on_the_block(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    project = studio.page.url.rstrip("/").split("/")[-1]
    studio.page.evaluate(
        "async ([project, path]) => { const p = await (await fetch(`/api/v1/projects/${project}`)).json();"
        " const f = p.files.find(f => f.path === path);"
        " return (await fetch(`/api/v1/projects/${project}/changes`, {method: 'POST',"
        " headers: {'Content-Type': 'application/json'},"
        " body: JSON.stringify({message: 'delete it',"
        " files: [{path, base_revision: f.revision, delete: true}]})})).status }",
        [project, FORWARD],
    )
    studio.page.reload()
    expect(studio.at("node-n6")).to_be_visible()
    expect(studio.at("node-n6")).to_have_attribute("data-problem", "error")
    studio.at("run").click()
    expect(studio.at("problems")).to_contain_text("Forward")
    studio.picture("problem")


def test_a_port_in_use_is_said_in_one_sentence(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        serve = command("serve", "--no-browser", "--port", port, "--data-dir", str(tmp_path))
        result = subprocess.run(serve, capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode == 1
    assert port in result.stderr
    assert "--port" in result.stderr, "the remedy is named"
    assert "Traceback" not in result.stderr + result.stdout
