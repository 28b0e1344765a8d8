"""Programs and domain of a session."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.manager.manager import free_domain_id, session_programs
from executor.recorder.link import ADDRESS_VARIABLE

if TYPE_CHECKING:
    from executor.session.events import Kind

KINDS: Final[tuple[Kind, ...]] = ("world", "application")


def test_a_session_has_a_domain_and_four_programs() -> None:
    domain_id = free_domain_id()
    assert 0 <= domain_id <= 101
    programs = session_programs(domain_id)
    assert set(programs) == {"world", "application", "recorder", "evaluation"}
    for kind in KINDS:
        assert programs[kind].environment["ROS_DOMAIN_ID"] == str(domain_id)
    addresses = {
        program.environment[ADDRESS_VARIABLE] for kind, program in programs.items() if kind != "evaluation"
    }
    assert len(addresses) == 1
    assert programs["evaluation"].environment["PYTHONHASHSEED"] == "0"  # equal seeds are equal runs
    assert session_programs(domain_id)["recorder"].environment[ADDRESS_VARIABLE] not in addresses
