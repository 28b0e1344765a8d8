"""The examples drive: each does what it teaches, with as many seeds as the budget says."""

from pathlib import Path

import pytest

from tests.budget import count
from tests.executor.forks import completed

ROOT = Path(__file__).parents[3]
NAMES = sorted(path.parent.name for path in (ROOT / "examples").glob("*/project.json"))

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(600)]


@pytest.mark.parametrize("name", NAMES)
def test_an_example_does_what_it_teaches(name: str) -> None:
    done = completed("tests.executor.headless.example_runs", count("example_seeds"), name)
    [row] = [line for line in done.stdout.splitlines() if line.startswith("|")]
    _, shown, _, share, _ = (cell.strip(" `") for cell in row.split("|"))
    assert shown == name
    succeeded, _, seeds = share.partition(" of ")
    # With many seeds some fail: the table in docs/how-to/examples.md says how many.
    assert int(succeeded) >= max(1, 0.8 * int(seeds)), done.stderr
