"""The page behind a read-only link."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlencode

from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.views.decorators.cache import never_cache
from django.views.decorators.http import require_safe

from backend.accounts import links
from backend.accounts.identity import LINKS
from backend.accounts.sign_in.pages import dead_link
from backend.projects.storage.access import open_links

if TYPE_CHECKING:
    from collections.abc import MutableMapping

MAX_LINKS = 50
# What the address of a project says of the moment at which the page looks.
MOMENT = ("run", "t")


@never_cache
@require_safe
def shared(request: HttpRequest, token: str) -> HttpResponse:
    """Stores the link in this browser's session, and redirects to the project, or to the moment of a run."""
    identity = links.identity_of("shared", token)
    found = open_links([identity]).first() if identity else None
    if found is None:
        return dead_link(request)
    kept: MutableMapping[str, str] = dict(request.session.get(LINKS, {}))
    kept[str(found.project_id)] = str(found.id)
    request.session[LINKS] = dict(list(kept.items())[-MAX_LINKS:])
    moment = urlencode({name: request.GET[name] for name in MOMENT if name in request.GET})
    return HttpResponseRedirect(f"/projects/{found.project_id}{moment and '?'}{moment}")
