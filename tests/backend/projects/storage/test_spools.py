"""Contents in a temporary file."""

from __future__ import annotations

import hashlib

from backend.core.scratch import scratch
from backend.projects.storage.spools import Spool


def test_contents_are_read_again_until_the_spool_is_closed():
    before = scratch().used
    with Spool() as spool:
        first = spool.add([b"one", b" and more"])
        empty = spool.add([])
        last = spool.add([b"two"])
        assert [each.data for each in (last, empty, first, last)] == [b"two", b"", b"one and more", b"two"]
        assert (first.size, first.sha256) == (12, hashlib.sha256(b"one and more").hexdigest())
        assert scratch().used == before + 15
    assert scratch().used == before
