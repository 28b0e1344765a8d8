"""Bundles: what cannot be used says why, and a renewed file counts at once."""

from __future__ import annotations

import pytest

from backend.sessions.hosts.authority import host_bundle, renew_web_bundle
from backend.sessions.relay.tls import (
    WEB,
    Bundle,
    BundleError,
    client_context,
    has_role,
    role_uri,
    server_context,
)


@pytest.fixture
def bundle(tmp_path):
    path = tmp_path / "host.pem"
    path.write_text(host_bundle(tmp_path / "authority", "robots.lan"))
    return path


def test_a_role_is_a_name_of_the_certificate():
    assert has_role({"subjectAltName": (("DNS", "x"), ("URI", role_uri(WEB)))}, WEB)
    assert not has_role({"subjectAltName": (("DNS", role_uri(WEB)),)}, WEB)
    assert not has_role({"subjectAltName": (("URI", role_uri(WEB) + "x"),)}, WEB)
    assert not has_role({}, WEB)
    assert not has_role(None, WEB)


@pytest.mark.parametrize("read", [server_context, client_context])
def test_a_bundle_that_cannot_be_used_is_named(bundle, read):
    read(bundle)
    key, certificate, _ = bundle.read_text().split("-----BEGIN CERTIFICATE-----")
    for text in ("", key, f"{key}-----BEGIN CERTIFICATE-----{certificate}", "ä", key + "x" * 1000):
        bundle.write_text(text)
        with pytest.raises(BundleError, match=r"host\.pem"):
            read(bundle)
    bundle.unlink()
    with pytest.raises(BundleError, match="hosts certificate"):
        read(bundle)


def test_a_renewed_file_counts_at_once_and_a_damaged_one_never(bundle, tmp_path):
    watched = Bundle(bundle, server_context)
    first = watched.context()
    assert watched.context() is first
    bundle.write_text("half")
    assert watched.context() is first
    bundle.unlink()
    assert watched.context() is first
    bundle.write_text(host_bundle(tmp_path / "authority", "robots.lan"))
    second = watched.context()
    assert second is not first
    assert watched.context() is second


def test_without_a_file_there_is_no_context_until_one_comes(tmp_path):
    watched = Bundle(tmp_path / "web.pem", client_context)
    with pytest.raises(BundleError):
        watched.context()
    assert renew_web_bundle(tmp_path) == tmp_path / "web.pem"
    assert watched.context().check_hostname
