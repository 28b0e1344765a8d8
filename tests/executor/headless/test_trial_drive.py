"""The test drive of an imported robot, and what it sets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.headless.trial_drive import Trial, drive_once, fit, write_robot
from executor.robots import load_robot
from executor.robots.importing.bring import Made, make_robot, places_of
from tests.executor.robots.importing.carts import BODY, CASTOR, PAIR, robot, wheel

if TYPE_CHECKING:
    from pathlib import Path


def made_of(folder: Path, *parts: str) -> Made:
    file = folder / "cart.urdf"
    file.write_text(robot(*parts))
    return make_robot(file, "cart", places_of(file, file, None))


def test_a_robot_moves_as_commanded(tmp_path: Path) -> None:
    made = made_of(
        tmp_path, BODY, PAIR, CASTOR.format(x=0.09), CASTOR.format(x=-0.09).replace("nose", "tail")
    )
    write_robot(made.written("cart.urdf"), tmp_path / "robots" / "cart")
    trial = drive_once("cart", tmp_path)
    assert trial.way_m == pytest.approx(1.0, abs=0.06)
    assert trial.aside_m == pytest.approx(0.0, abs=0.02)
    assert trial.turn_deg == pytest.approx(360.0, abs=12.0)


def test_wheels_that_must_slide_sideways_are_found_and_set(tmp_path: Path) -> None:
    four = [wheel(f"w{x}{y}", x * 0.12, y * 0.12) for x in (-1, 1) for y in (-1, 1)]
    made = made_of(tmp_path, BODY, *four)
    write_robot(made.written("cart.urdf"), tmp_path / "robots" / "cart")
    before = drive_once("cart", tmp_path)
    assert not before.turns
    trial = fit(made, "cart", "cart.urdf", tmp_path)
    assert trial.turns
    assert set(load_robot("cart", tmp_path).skid) == {f"w{x}{y}" for x in (-1, 1) for y in (-1, 1)}
    assert "its wheels slide sideways (skid: 0.05)" in "\n".join(made.report.assumed)


def test_what_does_not_fit_is_marked() -> None:
    assert Trial(1.02, 0.01, 355.0).fits
    for trial in (Trial(0.5, 0.0, 360.0), Trial(1.0, 0.2, 360.0), Trial(1.0, 0.0, 300.0)):
        assert not trial.fits
    assert str(Trial(0.5, 0, 300)) == ("1.00 m commanded, 0.50 m driven; 360° commanded, 300° turned")
