"""All URLs of a server with accounts: those of a local server, and the pages with forms."""

from __future__ import annotations

from django.urls import URLPattern, URLResolver, include, path, re_path

import backend.projects.administration
import backend.sessions.administration  # noqa: F401
from backend.accounts.administration import site
from backend.accounts.sign_in import pages
from backend.config import static
from backend.config.urls import api
from backend.projects.api import pages as project_pages
from backend.projects.api.views_legacy import urlpatterns as legacy

urlpatterns: list[URLPattern | URLResolver] = [
    path("api/v1/", include(api)),
    path("tree_api/", include(legacy)),
    path("accounts/", include("allauth.urls")),
    path("admin/", site.urls),
    path("join/<str:token>", pages.join),
    path("shared/<str:token>", project_pages.shared),
    path("", static.signed_in_page),
    re_path(r"^projects/[0-9a-f-]+/?$", static.signed_in_page),
]
handler404 = "backend.core.problems.not_found"
handler500 = "backend.core.problems.server_error"
