"""Programs and domain of a session."""

from __future__ import annotations

from executor.manager.manager import free_domain_id, session_programs


def test_a_session_has_a_domain_and_two_programs() -> None:
    domain_id = free_domain_id()
    assert 0 <= domain_id <= 101
    programs = session_programs(domain_id)
    assert {"world", "application"} <= set(programs)
    assert all(program.environment["ROS_DOMAIN_ID"] == str(domain_id) for program in programs.values())
