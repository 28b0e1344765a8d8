"""The relay as a process: who is let in, what is joined, and what hostile callers cost others."""

from __future__ import annotations

import asyncio
import ipaddress
import os
import socket
import ssl
import subprocess
from contextlib import suppress
from datetime import UTC, datetime, timedelta
from uuid import uuid4

import pytest
from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from backend.sessions.hosts.authority import host_bundle, renew_web_bundle
from backend.sessions.relay.hello import KEEPER, write_hello
from backend.sessions.relay.server import Limits
from backend.sessions.relay.tls import client_context
from tests.backend.sessions.relay.conftest import HOST, receive

SESSION = str(uuid4())
LONG_AGO = datetime.now(UTC) - timedelta(days=365)


@pytest.fixture
def started(relay):
    relay.open_socket(KEEPER)
    relay.open_socket(SESSION)
    relay.start()
    return relay


def other_bundle(relay, uri, path):
    """A certificate of a client that the relay's authority signed, with another role."""
    signer = (relay.authority / "authority.pem").read_bytes()
    authority, key = x509.load_pem_x509_certificate(signer), ec.generate_private_key(ec.SECP256R1())
    signing = serialization.load_pem_private_key(signer, None)
    assert isinstance(signing, ec.EllipticCurvePrivateKey)
    made = (
        x509.CertificateBuilder()
        .subject_name(x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "web")]))
        .issuer_name(authority.subject)
        .public_key(key.public_key())
        .serial_number(1)
        .not_valid_before(datetime.now(UTC) - timedelta(hours=1))
        .not_valid_after(datetime.now(UTC) + timedelta(hours=1))
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.CLIENT_AUTH]), critical=True)
        .add_extension(
            x509.SubjectAlternativeName(
                [x509.UniformResourceIdentifier(uri), x509.IPAddress(ipaddress.ip_address(HOST))]
            ),
            critical=False,
        )
        .sign(signing, hashes.SHA256())
    )
    pem = serialization.Encoding.PEM
    secret = key.private_bytes(pem, serialization.PrivateFormat.PKCS8, serialization.NoEncryption())
    path.write_bytes(secret + made.public_bytes(pem) + authority.public_bytes(pem))
    return path


def is_refused(relay, context, hello=None):
    """Returns whether a stream ends before anything came from the socket that it names."""
    try:
        with relay.secure(context) as stream:
            stream.sendall(write_hello(KEEPER) if hello is None else hello)
            return stream.recv(100) == b""
    except OSError:  # the alert may come at each of these
        return True


def answers(relay):
    with relay.join() as stream:
        return receive(stream, len(KEEPER) + 1) == b"keeper:"


@pytest.mark.parametrize("what", [KEEPER, SESSION])
async def test_a_stream_is_joined_to_the_socket_that_it_names(started, what):
    """Both directions at once: by asyncio, since two threads may not use one TLS stream."""
    data = os.urandom(3_000_000)
    context = client_context(started.web)
    reader, writer = await asyncio.open_connection(HOST, started.port, ssl=context, server_hostname=HOST)
    writer.write(write_hello(what))
    assert await reader.readexactly(len(what) + 1) == what.encode() + b":"
    writer.write(data)
    _, received = await asyncio.gather(writer.drain(), reader.readexactly(len(data)))
    assert received == data
    writer.write(b"bye")
    assert await reader.read() == b""
    writer.close()
    await writer.wait_closed()


def test_bytes_that_come_with_the_hello_are_passed_on(started):
    with started.secure() as stream:
        stream.sendall(write_hello(KEEPER) + b"early")
        assert receive(stream, 12) == b"keeper:early"


def test_only_the_role_of_a_web_server_is_let_in(started, tmp_path):
    host = tmp_path / "other.pem"
    host.write_text(host_bundle(started.authority, HOST))
    assert is_refused(started, client_context(host))  # it is for servers alone
    for uri in ("urn:bt-studio:role:host", "urn:bt-studio:role:web:x", "http://web"):
        assert is_refused(started, client_context(other_bundle(started, uri, tmp_path / "role.pem")))
    right = other_bundle(started, "urn:bt-studio:role:web", tmp_path / "role.pem")
    assert not is_refused(started, client_context(right))


def test_certificates_of_another_authority_or_that_have_ended_are_refused(started, tmp_path):
    other = client_context(renew_web_bundle(tmp_path / "another"))
    with pytest.raises(ssl.SSLCertVerificationError):
        started.secure(other)
    other.check_hostname, other.verify_mode = False, ssl.CERT_NONE
    assert is_refused(started, other)
    nobody = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    nobody.check_hostname, nobody.verify_mode = False, ssl.CERT_NONE
    assert is_refused(started, nobody)
    assert is_refused(started, client_context(renew_web_bundle(started.authority, LONG_AGO)))
    renew_web_bundle(started.authority)
    assert answers(started)


def test_a_web_server_refuses_a_host_of_another_name_or_an_ended_certificate(started):
    with pytest.raises(ssl.SSLCertVerificationError, match="mismatch"):
        started.secure(name="10.9.8.7")
    started.bundle.write_text(host_bundle(started.authority, HOST, LONG_AGO))
    with pytest.raises(ssl.SSLCertVerificationError, match="expired"):
        started.secure()
    # A renewed certificate needs no restart.
    started.bundle.write_text(host_bundle(started.authority, HOST))
    assert answers(started)


@pytest.mark.parametrize(
    "hello",
    [
        write_hello(str(uuid4())),
        b"bt-studio 1 ../../etc/passwd\n",
        b"bt-studio 2 keeper\n",
        b"GET / HTTP/1.1\r\n\r\n",
        b"x" * 1_000_000,
        b"\n",
        b"",
    ],
)
def test_a_hello_that_names_no_socket_ends_the_stream(started, hello):
    assert is_refused(started, None, hello)
    assert answers(started)


def test_a_slow_hello_ends_the_stream(started):
    with started.secure() as stream:
        stream.sendall(write_hello(KEEPER)[:-1])
        assert stream.recv(1) == b""
    assert answers(started)


def test_plain_connections_cost_others_nothing(started):
    many = Limits().callers * 3
    silent = [started.plain() for _ in range(many)]
    for each in silent[::2]:
        each.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
    assert answers(started)
    for each in silent:
        with each, suppress(OSError):
            while each.recv(100):
                pass
    assert answers(started)


def test_the_end_of_either_side_ends_the_other(started):
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(str(started.sockets / "sessions" / f"{(made := uuid4())}.sock"))
    listener.listen()
    with listener, started.join(str(made)) as stream:
        inner, _ = listener.accept()
        with inner:
            stream.sendall(b"hello")
            assert receive(inner, 5) == b"hello"
            stream.close()
            assert inner.recv(1) == b""


def sent_until_it_stops(stream):
    sent = 0
    try:
        while sent < 1 << 30:
            sent += stream.send(b"x" * 65536)
    except TimeoutError:
        pass
    return sent


def test_a_reader_that_does_not_read_holds_back_its_writer_alone(started):
    with started.join(SESSION) as stream:
        stream.settimeout(0.5)  # nobody reads, so that the sender must come to a stop
        assert sent_until_it_stops(stream) < 64 << 20
        assert answers(started)


def test_the_check_tells_whether_the_relay_works(started):
    def check():
        command, options = started.program("--check")
        return subprocess.run(command, **options, capture_output=True, text=True, check=False, timeout=60)

    assert check().returncode == 0
    started.bundle.write_text(host_bundle(started.authority, HOST, LONG_AGO))
    ended = check()
    assert ended.returncode == 1
    assert "expired" in ended.stderr
    assert "Traceback" not in ended.stderr


def test_without_a_bundle_the_relay_says_what_to_do(relay):
    relay.bundle.unlink()
    command, options = relay.program()
    done = subprocess.run(command, **options, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 1
    assert "bt-studio hosts certificate" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_signal_ends_the_relay_and_its_streams(started):
    with started.join() as stream:
        receive(stream, 7)
        started.process.terminate()
        assert started.process.wait(60) == 0
        assert stream.recv(1) == b""
