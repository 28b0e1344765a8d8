"""The programs of a session's processes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.application.groot import PORT_VARIABLE
from executor.manager.programs import session_programs
from executor.recorder.link import ADDRESS_VARIABLE

if TYPE_CHECKING:
    from executor.session.events import Kind

KINDS: Final[tuple[Kind, ...]] = ("world", "application")


def test_a_session_has_its_programs() -> None:
    domain_id = 7
    programs = session_programs(domain_id)
    assert set(programs) == {"world", "application", "exact", "recorder", "evaluation", "adapter"}
    assert programs["exact"].environment["PYTHONHASHSEED"] == "0"
    for kind in KINDS:
        assert programs[kind].environment["ROS_DOMAIN_ID"] == str(domain_id)
    addresses = {
        program.environment[ADDRESS_VARIABLE]
        for kind, program in programs.items()
        if kind in ("world", "application", "recorder")
    }
    assert len(addresses) == 1
    assert programs["evaluation"].environment["PYTHONHASHSEED"] == "0"  # equal seeds are equal runs
    assert not [part for part in programs["evaluation"].arguments if part.startswith("--cluster")]
    clustered = session_programs(domain_id, cluster="auto")["evaluation"].arguments
    assert clustered == (*programs["evaluation"].arguments, "--cluster=auto")
    assert PORT_VARIABLE not in programs["application"].environment
    shown = session_programs(domain_id, groot2=1667)
    with_port = [name for name, each in shown.items() if PORT_VARIABLE in each.environment]
    assert with_port == ["application", "exact"]
    assert session_programs(domain_id)["recorder"].environment[ADDRESS_VARIABLE] not in addresses
