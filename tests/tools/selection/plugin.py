"""A pytest plugin: leaves out what the selection leaves out, and gives each worker the files that suit it.

It is loaded by `-p tests.tools.selection.plugin`. `BT_STUDIO_SELECTION` names the file of a selection;
without it all tests run. With pytest-xdist the longest files come first.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.tools.selection.choose import Reason, Selection
from tests.tools.selection.table import TableError, file_of, read

if TYPE_CHECKING:
    from xdist.remote import Producer
    from xdist.scheduler import LoadScopeScheduling

VARIABLE = "BT_STUDIO_SELECTION"
SHARD_VARIABLE = "BT_STUDIO_SHARD_FILES"


def _selection() -> Selection | None:
    named = os.environ.get(VARIABLE)
    return Selection.load(Path(named)) if named else None


@cache
def _of_shard() -> frozenset[str] | None:
    named = os.environ.get(SHARD_VARIABLE)
    return frozenset(Path(named).read_text(encoding="utf-8").splitlines()) if named else None


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Passes over the files of other shards: collecting them costs more than to look."""
    files = _of_shard()
    if files is None or not collection_path.name.startswith("test_") or collection_path.suffix != ".py":
        return None
    return None if collection_path.relative_to(config.rootpath).as_posix() in files else True


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves out the dear tests that are neither touched nor drawn."""
    selection = _selection()
    if selection is None:
        return
    left_out = set(selection.tests(Reason.LEFT_OUT))
    dropped = [item for item in items if item.nodeid in left_out]
    if dropped:
        config.hook.pytest_deselected(items=dropped)
        items[:] = [item for item in items if item.nodeid not in left_out]


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Reports which of the failures this change did not touch."""
    selection = _selection()
    if selection is None:
        return
    sampled = set(selection.tests(Reason.SAMPLED))
    failed = {
        report.nodeid
        for outcome in ("failed", "error")
        for report in terminalreporter.stats.get(outcome, [])
        if getattr(report, "nodeid", None) in sampled
    }
    for test in sorted(failed):
        terminalreporter.write_line(
            f"{test}: not touched by this change: sampled (SAMPLE={selection.sample})"
        )


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> LoadScopeScheduling:
    """Returns the queue of files."""
    from tests.tools.selection.schedule import Files, Queue

    try:
        files = Files.of(read())
    except TableError:
        files = Files({}, frozenset())  # a checkout without a table runs in the order of collection
    return Queue(config, log, files, file_of)
