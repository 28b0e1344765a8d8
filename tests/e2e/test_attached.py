"""A program of BehaviorTree.CPP that runs by itself is followed, recorded, held and forced in the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import cpp_program

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence name="patrol"><Script code="round:=0"/>
<Repeat num_cycles="-1"><Sequence name="one_round"><Script code="round+=1"/>
<SubTree ID="Check" name="look"/><Sleep name="wait" msec="300"/></Sequence></Repeat></Sequence></BehaviorTree>
<BehaviorTree ID="Check"><Fallback name="is_free"><AlwaysFailure name="near"/><AlwaysSuccess name="far"/>
</Fallback></BehaviorTree></root>"""
WAIT = "u10"


def test_a_robot_of_cpp_is_followed_recorded_held_and_forced(studio: Studio) -> None:
    port = free_port()
    studio.open()
    with cpp_program(port, XML) as program:
        addresses_of_no_robot_are_refused(studio)
        it_is_followed(studio, port)
        studio.picture("attached")
        its_past_is_looked_at(studio)
        nothing_is_set_while_one_looks(studio)
        it_is_held(studio)
        a_result_is_forced(studio)
        assert program.stdin is not None
        program.stdin.close()
        program.wait()
    expect(studio.at("attached-strip")).to_contain_text("does not answer")
    with cpp_program(port, XML):
        expect(studio.at("attached-strip")).to_contain_text("You control")
        expect(studio.at(f"node-{WAIT}")).to_have_attribute("data-past", "FAILURE")
        studio.at("release").click()
        expect(studio.at(f"node-{WAIT}")).to_have_attribute("data-status", "RUNNING")
        studio.at("attached-save").click()
        expect(studio.at("import-report")).to_be_visible()
        its_recording_is_a_run_of_the_project(studio)
        the_session_is_ended(studio, port)


def its_recording_is_a_run_of_the_project(studio: Studio) -> None:
    project = studio.page.url.split("?", maxsplit=1)[0].rstrip("/").split("/")[-1]
    ask = "project => fetch(`/api/v1/projects/${project}/runs`).then((answer) => answer.json())"
    [run] = studio.page.evaluate(ask, project)["items"]
    assert run["name"].startswith("Recording of 127.0.0.1:")
    assert run["length_s"] > 1


def the_session_is_ended(studio: Studio, port: int) -> None:
    """The start of the same session again returns its id."""
    studio.page.evaluate(
        "async address => { const json = {'Content-Type': 'application/json'};"
        " const body = JSON.stringify({address});"
        " const path = '/api/v1/sessions';"
        " const answer = await fetch(`${path}/attached`, {method: 'POST', headers: json, body});"
        " await fetch(`${path}/${(await answer.json()).id}`, {method: 'DELETE'}); }",
        f"127.0.0.1:{port}",
    )


def addresses_of_no_robot_are_refused(studio: Studio) -> None:
    studio.may_be_refused("400 POST /api/v1/sessions/attached")
    studio.at("attach").click()
    for address, words in (("ipc:///tmp/x", "TCP"), ("*:1667", "every address"), ("", "Write the name")):
        studio.at("attach-address").fill(address)
        studio.page.keyboard.press("Enter")
        expect(studio.page.get_by_role("dialog")).to_contain_text(words)


def it_is_followed(studio: Studio, port: int) -> None:
    studio.at("attach-address").fill(f"127.0.0.1:{port}")
    studio.page.keyboard.press("Enter")
    expect(studio.at(f"node-{WAIT}")).to_have_attribute("data-status", "RUNNING")
    expect(studio.at("attached-age")).to_contain_text("ago")
    expect(studio.page.get_by_text("round", exact=True).first).to_be_visible()


def its_past_is_looked_at(studio: Studio) -> None:
    expect(studio.at("time-axis")).to_be_visible()
    studio.page.wait_for_function(
        "() => parseFloat(document.querySelector('[data-testid=axis-time]')?.textContent ?? '0') > 3"
    )
    studio.at("axis-strip").click(position={"x": 60, "y": 8})
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    studio.page.keyboard.press("Escape")


def nothing_is_set_while_one_looks(studio: Studio) -> None:
    studio.at(f"node-{WAIT}").click()
    studio.at(f"breakpoint-{WAIT}").click()
    expect(studio.at("attached-strip")).to_contain_text("only looks")


def it_is_held(studio: Studio) -> None:
    studio.at("attached-control").click(force=True)
    expect(studio.at("attached-control")).to_be_checked()
    expect(studio.at(f"node-{WAIT}")).to_have_attribute("data-held", "here")
    expect(studio.at("held-banner")).to_contain_text("wait")
    studio.picture("attached-held")
    studio.page.keyboard.press("F5")


def a_result_is_forced(studio: Studio) -> None:
    studio.at(f"breakpoint-{WAIT}").click()
    expect(studio.at("held-banner")).to_be_hidden()
    studio.at(f"node-{WAIT}").click(button="right")
    studio.at("menu-forceFailure").click()
    expect(studio.at(f"forced-Main/{WAIT}")).to_contain_text("FAILURE")
    expect(studio.at(f"node-{WAIT}")).to_have_attribute("data-past", "FAILURE")
