"""Encrypts connections to a program that listens on a network, by the files of a certificate."""

from __future__ import annotations

import ssl

__all__ = ["CertificateError", "server_context"]


class CertificateError(ValueError):
    """Raised when the options of a certificate cannot be used; the text says why."""


def server_context(certificate: str, key: str) -> ssl.SSLContext | None:
    """Returns what encrypts connections; None without both files.

    Raises:
        CertificateError: only one file is given, or they hold no certificate and its key.
    """
    if not certificate and not key:
        return None
    if not certificate or not key:
        raise CertificateError("--tls-cert and --tls-key are given together")
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    try:
        context.load_cert_chain(certificate, key)
    except (OSError, ValueError) as error:
        files = f"{certificate} and {key}"
        raise CertificateError(f"{files} are no certificate and its key, as PEM: {error}") from error
    return context
