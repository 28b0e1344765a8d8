"""All URLs of the server; sockets are in `asgi`."""

from __future__ import annotations

from django.urls import URLPattern, URLResolver, include, path, re_path

from backend.config import static
from backend.config.schema_view import OpenApi, docs
from backend.projects.api.views_legacy import urlpatterns as legacy

api: list[URLPattern | URLResolver] = [
    path("", include("backend.projects.api.urls")),
    path("", include("backend.catalog.urls")),
    path("", include("backend.sessions.urls")),
    path("", include("backend.runs.urls")),
    path("", include("backend.evaluations.urls")),
    path("", include("backend.language.urls")),
    path("", include("backend.imports.urls")),
    path("", include("backend.accounts.api.urls")),
    path("openapi.json", OpenApi.as_view()),
    path("docs", docs),
]
urlpatterns = [
    path("api/v1/", include(api)),
    path("tree_api/", include(legacy)),
    path("", static.page),
    re_path(r"^projects/[0-9a-f-]+/?$", static.page),
    re_path(r"^attached/[0-9a-f-]+/?$", static.page),
]
handler404 = "backend.core.problems.not_found"
handler500 = "backend.core.problems.server_error"
