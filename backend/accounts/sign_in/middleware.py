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
    """Base of Django's middleware that skips every path without forms."""

    get_response: Any

    def __call__(self, request: HttpRequest) -> Any:
        """Django's entry, in the sync and in the async chain."""
        if request.path_info.startswith(PAGES):
            return super().__call__(request)  # type: ignore[misc]
        return self.get_response(request)


class PageSession(OnPages, SessionMiddleware):
    """Sessions on pages with forms."""


class PageLocale(OnPages, LocaleMiddleware):
    """The language that the browser requests, on pages with forms."""


class PageCsrf(OnPages, CsrfViewMiddleware):
    """Checks a token in every form, in addition to the Origin that the guard checks for all requests."""

    def process_view(self, request: HttpRequest, *args: Any, **kwargs: Any) -> Any:
        """Checks the token; called by Django for each view."""
        if request.path_info.startswith(PAGES):
            return super().process_view(request, *args, **kwargs)
        return None


class PageUser(OnPages, AuthenticationMiddleware):
    """Sets the user who is signed in."""


class PageMessages(OnPages, MessageMiddleware):
    """Django's messages on pages with forms."""
