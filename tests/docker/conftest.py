"""The Docker part runs in `make test-full` and `make test-docker` where an engine is available.

Elsewhere the report says that it did not run.
"""

from __future__ import annotations

from tests.budget import count
from tests.docker.engine import why_not

REASON = why_not() if count("docker_stack") else "`make test-docker` runs it"
HEAVY = [
    *("test_acme.py", "test_gate.py", "test_hostile.py", "test_local.py", "test_ring.py"),
    *("test_sealed.py", "test_stack.py", "test_up.py", "test_upgrade.py"),
]
collect_ignore = HEAVY if REASON else []


def pytest_terminal_summary(terminalreporter):
    """Repeats the reason at the end of the report, where it is visible."""
    if REASON:
        terminalreporter.write_line(f"tests/docker was NOT run: {REASON}.", yellow=True)
