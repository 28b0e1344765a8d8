"""Certificates of managers on other machines."""

from __future__ import annotations

import hashlib

from cryptography import x509
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric import ec

from backend.sessions.manager.certificate import make_certificate


def test_each_session_has_a_key_of_its_own_that_no_text_shows() -> None:
    made, other = make_certificate("one"), make_certificate("one")
    assert made.digest != other.digest
    assert "PRIVATE KEY" in made.key
    assert made.key not in repr(made)


def test_the_digest_is_that_of_the_certificate_and_the_key_is_its_key() -> None:
    made = make_certificate("3f2a")
    certificate = x509.load_pem_x509_certificate(made.certificate.encode())
    assert made.digest == hashlib.sha256(certificate.public_bytes(serialization.Encoding.DER)).hexdigest()
    assert certificate.subject.rfc4514_string() == "CN=3f2a"
    key = serialization.load_pem_private_key(made.key.encode(), None)
    assert isinstance(key, ec.EllipticCurvePrivateKey)
    assert key.public_key() == certificate.public_key()
    assert certificate.not_valid_before_utc < certificate.not_valid_after_utc
