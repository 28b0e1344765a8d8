"""Serves the built front end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from django.conf import settings
from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.shortcuts import render
from django.views.decorators.http import require_safe
from whitenoise.middleware import WhiteNoiseMiddleware

from backend.accounts.identity import identify
from backend.core.scopes import API

if TYPE_CHECKING:
    from collections.abc import Callable


class FrontEndFiles(WhiteNoiseMiddleware):  # type: ignore[misc]
    """Serves the front end with WhiteNoise, from memory.

    The file iterator of WhiteNoise would block the event loop.
    """

    def __init__(self, get_response: Callable[[HttpRequest], HttpResponse]) -> None:
        super().__init__(get_response, settings)

    def __call__(self, request: HttpRequest) -> HttpResponse:
        """Serves a file if it exists. Paths that never name files are skipped."""
        is_api = request.path_info.startswith(API)
        answer: HttpResponse = self.get_response(request) if is_api else super().__call__(request)
        return answer

    def immutable_file_test(self, path: str, url: str) -> bool:
        """Returns whether a file never changes: Vite puts a hash of the content into each asset's name."""
        return url.startswith("/assets/")

    @staticmethod
    def serve(static_file: Any, request: HttpRequest) -> HttpResponse:
        """Returns one file, or a part of it."""
        found = static_file.get_response(request.method, request.META)
        content = b""
        if found.file is not None:
            with found.file as file:
                content = file.read()
        response = HttpResponse(content, status=int(found.status))
        del response["content-type"]
        for name, value in found.headers:
            if name.lower() != "access-control-allow-origin":
                response[name] = value
        return response


@require_safe
def page(request: HttpRequest, project_id: object = None) -> HttpResponse:
    """Returns the front end's page, for every path that the front end handles."""
    index = settings.ENVIRONMENT.frontend_dir / "index.html"
    try:
        content = index.read_bytes()
    except FileNotFoundError:
        return render(request, "config/not_built.html", status=503)
    response = HttpResponse(content, content_type="text/html; charset=utf-8")
    response.headers["Cache-Control"] = "no-cache"
    return response


@require_safe
def signed_in_page(request: HttpRequest, project_id: object = None) -> HttpResponse:
    """Returns the front end's page to signed-in users and to guests with a link.

    Redirects others to the sign-in.
    """
    user = identify(request.COOKIES)
    if user is None or (user.is_guest and request.path_info == "/"):
        following = urlencode({"next": request.get_full_path()}) if request.path_info != "/" else ""
        return HttpResponseRedirect(f"{settings.LOGIN_URL}?{following}".rstrip("?"))
    return page(request, project_id)
