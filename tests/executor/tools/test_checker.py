"""One run of ruff on a text."""

from __future__ import annotations

from executor.tools.checker import run_ruff


async def test_ruff_answers_with_its_status_and_output() -> None:
    answer = await run_ruff(["format", "-"], "x = {  'a':1 }\n")
    assert answer == {"status": 0, "output": 'x = {"a": 1}\n'}
    assert (await run_ruff(["check", "--isolated", "-"], "import os\n"))["status"] == 1
