"""Enumerations by hand: the file is made in the Explorer, a port offers its names, a bad number is found."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

TURN = '''import py_trees

from tree_gardener import Port, get_input


class Turn(py_trees.behaviour.Behaviour):
    """Shows a colour."""

    INPUT_PORTS = {"color": Port("Color", default="RED"), "ang_speed": Port(float, default=0.5)}

    def update(self):
        print("color", get_input(self, "color"))
        return py_trees.common.Status.SUCCESS
'''
BAD = '{"format": "bt-studio/enums", "version": 1,\n"enums": {"Color": {"RED": 0, "GREEN": 1.5}}}\n'
GOOD = BAD.replace("1.5", "7")


def test_an_enumeration_is_made_and_used(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    the_file_is_made(studio)
    write(studio, "actions/Turn.py", TURN)
    a_port_offers_its_names(studio)
    a_bad_number_is_found(studio)


def write(studio: Studio, path: str, text: str) -> None:
    """Opens a file and replaces its text; other files may be open beside it."""
    studio.at(f"file-{path}").click()
    editor = studio.page.locator(f'[data-testid="code-editor"][data-path="{path}"] .cm-content')
    editor.click()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(text)
    studio.saved()


def the_file_is_made(studio: Studio) -> None:
    studio.at("new-file").click()
    studio.writing()
    studio.page.keyboard.type("enums.json")
    studio.page.keyboard.press("Enter")
    expect(studio.at("file-enums.json")).to_be_visible()
    expect(studio.at("code-editor")).to_contain_text('"RED": 0')
    studio.saved()


def a_port_offers_its_names(studio: Studio) -> None:
    studio.at("file-trees/MainTree.json").click()
    block(studio, "Turn").click()
    field = studio.at("port-color")
    expect(field).to_have_value("RED")
    field.click()
    expect(studio.page.get_by_role("option", name="BLUE")).to_be_visible()
    studio.picture("enums-port")
    studio.page.get_by_role("option", name="GREEN").click()
    expect(block(studio, "Turn")).to_contain_text("GREEN")
    expect(block(studio, "Turn")).not_to_have_attribute("data-problem", "error")
    studio.saved()


def a_bad_number_is_found(studio: Studio) -> None:
    write(studio, "enums.json", BAD)
    studio.page.get_by_role("tab", name="Problems").click()
    problems = studio.at("problems")
    expect(problems).to_contain_text("which is not a whole number that an enumeration can hold")
    expect(problems).to_contain_text("enums.json:2")
    studio.picture("enums-problem")
    write(studio, "enums.json", GOOD)
    expect(problems).not_to_contain_text("not a whole number")
