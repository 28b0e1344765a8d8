"""The Docker part of the suite runs where an engine can be had; elsewhere the report says that it did not."""

from __future__ import annotations

from tests.docker.engine import why_not

REASON = why_not()
collect_ignore = ["test_stack.py"] if REASON else []


def pytest_terminal_summary(terminalreporter):
    """Says so at the end, where it is seen."""
    if REASON:
        terminalreporter.write_line(f"tests/docker was NOT run: {REASON}.", yellow=True)
