"""Numbers that the environment gives."""

from __future__ import annotations

import pytest

from executor.manager.environment import WrongVariableError, mebibytes, number
from executor.manager.manager import Manager, ManagerSettings, main


@pytest.mark.parametrize(("text", "found"), [(None, 15), ("", 15), (" ", 15), ("0", 0), (" 2.5 ", 2.5)])
def test_a_number_is_read_or_its_default_holds(text: str | None, found: float) -> None:
    environment = {} if text is None else {"MINUTES": text}
    assert number("MINUTES", 15, environment) == found


@pytest.mark.parametrize("text", ["many", "-1", "nan", "inf", "1e999"])
def test_what_is_no_number_is_refused_by_its_name(text: str) -> None:
    with pytest.raises(WrongVariableError, match="MINUTES: "):
        number("MINUTES", 15, {"MINUTES": text})


def test_mebibytes_become_bytes() -> None:
    assert mebibytes("ROOM_MB", 4, {}) == 4 << 20
    assert mebibytes("ROOM_MB", 4, {"ROOM_MB": "0.5"}) == 1 << 19


@pytest.mark.parametrize("name", ["BT_STUDIO_HOLD_MINUTES", "BT_STUDIO_APPLICATION_MEMORY_MB"])
def test_a_manager_says_which_variable_is_wrong(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(name, "soon")
    assert main(["--port", "0"]) == 2
    assert capsys.readouterr().err == f"bt-studio manager: {name}: 'soon' is not a number\n"


@pytest.mark.parametrize(("text", "limit_s"), [("5", 300.0), ("0", 0.0), ("", 900.0)])
async def test_a_tree_is_held_as_long_as_the_environment_says(
    text: str, limit_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BT_STUDIO_HOLD_MINUTES", text)
    manager = Manager(ManagerSettings(port=0, programs={}))
    assert manager.session.about.hold_limit_s == limit_s
