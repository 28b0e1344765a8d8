"""Django's middleware for pages with forms (sign-in, administration); API requests skip it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from django.contrib.auth.middleware import AuthenticationMiddleware
from django.contrib.messages.middleware import MessageMiddleware
from django.contrib.sessions.middleware import SessionMiddleware
from django.middleware.csrf import CsrfViewMiddleware
from django.middleware.locale import LocaleMiddleware

if TYPE_CHECKING:
    from django.http import HttpRequest

PAGES: Final = ("/accounts/", "/admin/", "/join/", "/shared/")


class OnPages:
    """Base class of Django middleware that skips all paths without forms."""

    get_response: Any

    def __call__(self, request: HttpRequest) -> Any:
        """Handles a request; Django calls it in the synchronous and the asynchronous chain."""
        if request.path_info.startswith(PAGES):
            return super().__call__(request)  # type: ignore[misc]
        return self.get_response(request)


class PageSession(OnPages, SessionMiddleware):
    """Sessions on pages with forms."""


class PageLocale(OnPages, LocaleMiddleware):
    """Sets the language that the browser requests, on pages with forms."""


class PageCsrf(OnPages, CsrfViewMiddleware):
    """Checks a token in every form, in addition to the Origin that the guard checks for all requests."""

    def process_view(self, request: HttpRequest, *args: Any, **kwargs: Any) -> Any:
        """Checks the token; called by Django for each view."""
        if request.path_info.startswith(PAGES):
            return super().process_view(request, *args, **kwargs)
        return None


class PageUser(OnPages, AuthenticationMiddleware):
    """Sets the signed-in user on pages with forms."""


class PageMessages(OnPages, MessageMiddleware):
    """Django's messages on pages with forms."""
