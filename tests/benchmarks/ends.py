"""Ends 60 exported programs, by every cause in each way to run them, while they drive a simulated robot.

Prints a line for each kind of program, and each program whose robot did not stand within 0.3 s of simulated
time, whose exit status was another one, or whose log had not the error. Exit status 1 if there was one.
"""

from __future__ import annotations

import sys
import tempfile
from itertools import chain, cycle, islice
from pathlib import Path
from typing import Final

from tests.action_errors.stopping import CAUSES, COMMON, STANDS_WITHIN_S, Yard, end
from tests.domains import own_domain_id
from tests.tree_gardener.programs import Peer

PROGRAMS: Final = 60


def main() -> None:
    """Ends the programs."""
    domain_id = own_domain_id()
    peer = Peer(domain_id)
    yard = Yard(peer, domain_id)
    plain = [(way, cause, "Twist") for way, causes in CAUSES.items() for cause in causes]
    stamped = [("plain", cause, "TwistStamped") for cause in COMMON]
    cells = islice(cycle(chain(plain, stamped)), PROGRAMS)
    right: dict[str, int] = {}
    wrong = 0
    for way, cause, kind in cells:
        with tempfile.TemporaryDirectory() as folder:
            ended = end(yard, Path(folder) / "program", way, cause, kind)
        name = f"{way}, {kind}"
        if ended.stands and ended.is_told and ended.status == ended.wanted_status:
            right[name] = right.get(name, 0) + 1
        else:
            wrong += 1
            print(f"{name}, {cause}: {ended}", flush=True)
    peer.close()
    for name, count in right.items():
        print(f"{name}: {count} programs ended, the robot stood within {STANDS_WITHIN_S} s", flush=True)
    if wrong:
        sys.exit(1)


if __name__ == "__main__":
    main()
