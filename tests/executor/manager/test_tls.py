"""The files of a certificate; `test_manager.py` shows what is said of wrong ones."""

from __future__ import annotations

import ssl
from typing import TYPE_CHECKING

import pytest

from backend.sessions.manager.certificate import make_certificate
from executor.manager.tls import CertificateError, server_context

if TYPE_CHECKING:
    from pathlib import Path


def test_a_certificate_and_its_key_encrypt_and_nothing_does_not(tmp_path: Path) -> None:
    made = make_certificate("s1")
    files = tmp_path / "crt", tmp_path / "key"
    for file, text in zip(files, (made.certificate, made.key), strict=True):
        file.write_text(text)
    context = server_context(*map(str, files))
    assert context is not None
    assert context.minimum_version == ssl.TLSVersion.TLSv1_3
    assert server_context("", "") is None
    with pytest.raises(CertificateError, match="as PEM"):
        server_context(str(files[1]), str(files[0]))
