"""The private authority that signs the certificates of web server and hosts.

Its folder belongs to the web server. There is nothing to revoke with: a host connects to nobody, so that
taking it off `BT_STUDIO_EXECUTOR_HOSTS` ends the use of its certificate. A web server's certificate that was
stolen is worth nothing once the folder is removed and all certificates are made again.
"""

from __future__ import annotations

import fcntl
import ipaddress
import os
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from backend.sessions.relay.tls import HOST, WEB, role_uri

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["WEB_BUNDLE", "AuthorityError", "host_bundle", "renew_web_bundle", "valid_until"]

WEB_BUNDLE: Final = "web.pem"
_AUTHORITY: Final = "authority.pem"
_LOCK: Final = "lock"
VALID: Final = timedelta(days=90)
AUTHORITY_VALID: Final = timedelta(days=3650)
# Clocks of machines differ.
_EARLIER: Final = timedelta(hours=1)
_PURPOSES: Final = {WEB: ExtendedKeyUsageOID.CLIENT_AUTH, HOST: ExtendedKeyUsageOID.SERVER_AUTH}


class AuthorityError(Exception):
    """The folder of the authority cannot be used; the text says why."""


def renew_web_bundle(folder: Path, now: datetime | None = None) -> Path:
    """Makes a new certificate for the web server, and the authority if there is none; returns its file.

    Raises:
        AuthorityError: the folder cannot be used.
    """
    with _authority(folder) as (key, certificate):
        path = folder / WEB_BUNDLE
        _write(path, _issue(key, certificate, WEB, "web", now))
        return path


def host_bundle(folder: Path, host: str, now: datetime | None = None) -> str:
    """Returns a new certificate for a host, with its key and the authority's certificate. It is not stored.

    Args:
        folder: the folder of the authority, which is made if it is missing.
        host: the host's name or address, under which the web server reaches it.
        now: the time from which it is valid; None is now.

    Raises:
        AuthorityError: the folder cannot be used.
    """
    with _authority(folder) as (key, certificate):
        return _issue(key, certificate, HOST, host, now)


def valid_until(bundle: str) -> datetime:
    """Returns the time at which the certificate of a bundle ends.

    Raises:
        ValueError: the text has no certificate.
    """
    return x509.load_pem_x509_certificate(bundle.encode()).not_valid_after_utc


@contextmanager
def _authority(folder: Path) -> Iterator[tuple[ec.EllipticCurvePrivateKey, x509.Certificate]]:
    """Yields the authority's key and certificate; one process at a time."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        with (folder / _LOCK).open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            path = folder / _AUTHORITY
            if not path.exists():
                _write(path, _new_authority())
            text = path.read_bytes()
            key = serialization.load_pem_private_key(text, password=None)
            if not isinstance(key, ec.EllipticCurvePrivateKey):
                raise AuthorityError(f"{path} has a key of another kind.")
            yield key, x509.load_pem_x509_certificate(text)
    except OSError as error:
        raise AuthorityError(f"The folder {folder} cannot be used: {error}.") from error
    except ValueError as error:
        hint = "Remove the folder, and make all certificates again."
        raise AuthorityError(f"{folder / _AUTHORITY} is damaged: {error}. {hint}") from error


def _new_authority() -> str:
    key = ec.generate_private_key(ec.SECP256R1())
    name = _name("BT Studio executors")
    made = (
        _builder(key, name, name, AUTHORITY_VALID)
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(_usage(signs_certificates=True), critical=True)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
        .sign(key, hashes.SHA256())
    )
    return _pem(key) + _pem_of(made)


def _issue(
    key: ec.EllipticCurvePrivateKey,
    authority: x509.Certificate,
    role: str,
    name: str,
    now: datetime | None,
) -> str:
    own = ec.generate_private_key(ec.SECP256R1())
    names: list[x509.GeneralName] = [x509.UniformResourceIdentifier(role_uri(role))]
    if role == HOST:
        names.append(_host_name(name))
    made = (
        _builder(own, _name(name), authority.subject, VALID, now)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(_usage(signs_certificates=False), critical=True)
        .add_extension(x509.ExtendedKeyUsage([_PURPOSES[role]]), critical=True)
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(own.public_key()), critical=False)
        .add_extension(
            x509.AuthorityKeyIdentifier.from_issuer_public_key(key.public_key()),
            critical=False,
        )
        .sign(key, hashes.SHA256())
    )
    return _pem(own) + _pem_of(made) + _pem_of(authority)


def _host_name(name: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(name))
    except ValueError:
        return x509.DNSName(name)


def _builder(
    key: ec.EllipticCurvePrivateKey,
    subject: x509.Name,
    issuer: x509.Name,
    valid: timedelta,
    now: datetime | None = None,
) -> x509.CertificateBuilder:
    now = now or datetime.now(UTC)
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - _EARLIER)
        .not_valid_after(now + valid)
    )


def _name(text: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, text[:64])])


def _usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )


def _pem(key: ec.EllipticCurvePrivateKey) -> str:
    kind, plain = serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    return key.private_bytes(serialization.Encoding.PEM, kind, plain).decode()


def _pem_of(certificate: x509.Certificate) -> str:
    return certificate.public_bytes(serialization.Encoding.PEM).decode()


def _write(path: Path, text: str) -> None:
    """Writes a file that only its owner reads; it appears whole."""
    partial = path.with_name(f".{path.name}.new")
    partial.unlink(missing_ok=True)
    descriptor = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with os.fdopen(descriptor, "w") as file:
        file.write(text)
    partial.replace(path)
