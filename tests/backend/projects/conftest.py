"""Reports at the end the tests that could not run here."""

from __future__ import annotations

from tests.backend.disks import may_mount


def pytest_terminal_summary(terminalreporter):
    """PostgreSQL needs a small disk; for SQLite a limit on the size of files suffices."""
    if not may_mount():
        sentence = "PostgreSQL on a full disk was NOT tried: it takes root, and the right to mount a disk."
        terminalreporter.write_line(sentence, yellow=True)
