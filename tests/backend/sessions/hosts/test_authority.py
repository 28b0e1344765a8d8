"""The private authority: made once, private, and its certificates are for one role and one name each."""

from __future__ import annotations

import stat
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta

import pytest

from backend.sessions.hosts.authority import (
    AuthorityError,
    host_bundle,
    renew_web_bundle,
    valid_until,
)

END = "-----END CERTIFICATE-----\n"


def test_one_authority_signs_all_for_ninety_days(tmp_path):
    with ThreadPoolExecutor(4) as pool:
        made = list(
            pool.map(lambda name: host_bundle(tmp_path / "hosts", name), ["a.lan", "b.lan", "10.0.0.1"])
        )
    made.append(renew_web_bundle(tmp_path / "hosts").read_text())
    assert len({text.split(END)[1] for text in made}) == 1
    assert len({text.split(END)[0] for text in made}) == 4
    for text in made:
        left = valid_until(text) - datetime.now(UTC)
        assert timedelta(days=89) < left <= timedelta(days=90)


def test_keys_are_read_by_their_owner_alone(tmp_path):
    renew_web_bundle(tmp_path / "hosts")
    assert stat.S_IMODE((tmp_path / "hosts").stat().st_mode) == 0o700
    found = {path.name: stat.S_IMODE(path.stat().st_mode) for path in (tmp_path / "hosts").glob("*.pem")}
    assert found == {"authority.pem": 0o600, "web.pem": 0o600}


def test_a_folder_that_cannot_be_used_is_named(tmp_path):
    renew_web_bundle(tmp_path / "hosts")
    (tmp_path / "hosts" / "authority.pem").write_text("half")
    with pytest.raises(AuthorityError, match=r"authority\.pem is damaged"):
        host_bundle(tmp_path / "hosts", "a.lan")
    (tmp_path / "file").write_text("")
    with pytest.raises(AuthorityError, match="cannot be used"):
        renew_web_bundle(tmp_path / "file")
