"""Makes the certificate of a manager on another machine: for one session, and signed by itself."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from typing import Final

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import NameOID

__all__ = ["Certificate", "make_certificate"]

# No session lives as long. Clients compare the certificate itself, and read no dates.
_VALID: Final = timedelta(days=2)


@dataclass(frozen=True, slots=True)
class Certificate:
    """A certificate and its private key, as PEM, and the SHA-256 of the certificate in hexadecimal digits."""

    certificate: str
    key: str = field(repr=False)
    digest: str


def make_certificate(name: str) -> Certificate:
    """Returns a new certificate with a new key (ECDSA, P-256).

    Args:
        name: its common name, of at most 64 characters; it only helps people to tell certificates apart.
    """
    key = ec.generate_private_key(ec.SECP256R1())
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
    now = datetime.now(UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - timedelta(hours=1))
        .not_valid_after(now + _VALID)
        .sign(key, hashes.SHA256())
    )
    pem = serialization.Encoding.PEM
    secret = key.private_bytes(pem, serialization.PrivateFormat.PKCS8, serialization.NoEncryption())
    digest = hashlib.sha256(made.public_bytes(serialization.Encoding.DER)).hexdigest()
    return Certificate(made.public_bytes(pem).decode(), secret.decode(), digest)
