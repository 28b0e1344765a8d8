"""Downloads by a short-lived address of the object store, in place of a stream through the web server."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Final

from django.http import HttpResponse

from backend.config.environment import environment
from backend.core.objects.store import the_store

if TYPE_CHECKING:
    from django.http import HttpRequest

NEVER: Final = frozenset({".htm", ".html", ".mht", ".mhtml", ".shtml", ".svg", ".svgz", ".xht", ".xhtml"})
"""Endings of files that a browser could display as a page; the web server sends them with its own headers."""
_DESTINATIONS: Final = frozenset({"document", "empty"})
"""What browsers say of a link that is followed, and of a script that fetches; pictures must be ours (CSP)."""


def is_direct(request: HttpRequest, filename: str) -> bool:
    """Returns whether this request may be redirected, if the file is in the store.

    Only browsers are redirected, for whole files: programs of users need not follow redirects.
    """
    return (
        bool(environment().object_store_public)
        and request.method == "GET"
        and "Range" not in request.headers
        and request.headers.get("Sec-Fetch-Dest", "") in _DESTINATIONS
        and PurePosixPath(filename.lower().rstrip(". ")).suffix not in NEVER
    )


def redirected(key: str, filename: str) -> HttpResponse:
    """Returns the redirection to an address of one object, which is valid for a minute."""
    headers = {"Location": the_store().address(key, filename), "Cache-Control": "private, no-store"}
    return HttpResponse(status=302, headers=headers)
