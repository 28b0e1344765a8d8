"""Only one module determines the address of a client; no other module reads connections or headers for it."""

from __future__ import annotations

import re
from pathlib import Path

BACKEND = Path(__file__).parents[3] / "backend"
SOURCES = re.compile(
    r"REMOTE_ADDR|X_FORWARDED_FOR|x-forwarded-for|X-Forwarded-For|x-real-ip|scope\[.client.\]|scope\.get\(.client"
    r"|get_client_ip|getpeername|peername"
)
ALLOWED = {
    "core/clients.py": "the one place",
    "ingress/middleware.py": "hands both to clients.address_of, and keeps what it says",
    "ingress/owners.py": "hands both to clients.address_of",
    "config/probes.py": "hands both to clients.is_on_this_machine",
    "config/team.py": "words of a setting",
    "accounts/sign_in/adapters.py": "allauth's question, answered with what the guard kept",
}


def test_only_one_place_says_the_clients_address():
    found = {
        path.relative_to(BACKEND).as_posix()
        for path in BACKEND.rglob("*.py")
        if SOURCES.search(path.read_text(encoding="utf-8"))
    }
    assert found == set(ALLOWED)


def test_those_who_hand_it_on_ask_that_place():
    assert "address_of(request.META.get(" in (BACKEND / "ingress/middleware.py").read_text(encoding="utf-8")
    assert "is_on_this_machine(client[0]" in (BACKEND / "config/probes.py").read_text(encoding="utf-8")
    assert "client_address.get()" in (BACKEND / "accounts/sign_in/adapters.py").read_text(encoding="utf-8")
    throttle = (BACKEND / "accounts/permissions.py").read_text(encoding="utf-8")
    assert "client_address" in throttle
    assert "get_ident" not in throttle
