"""Django middleware: the guard for pages and API, and the headers of every answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from urllib.parse import quote, urlencode

from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.shortcuts import render

from backend.accounts.audit import client_address
from backend.accounts.sign_in.middleware import PAGES
from backend.config.environment import environment
from backend.core import guard
from backend.core.clients import FORWARDED, address_of, proxies
from backend.core.problems import problem, problem_response
from backend.core.scopes import API

if TYPE_CHECKING:
    from collections.abc import Callable

    from django.http.response import HttpResponseBase

CONTENT_SECURITY_POLICY: Final = "; ".join(
    (
        "default-src 'self'",
        "script-src 'self'",
        "style-src 'self' 'unsafe-inline'",  # Mantine sets style attributes
        "img-src 'self' data: blob:",
        "font-src 'self' data:",
        "connect-src 'self'",
        "worker-src 'self' blob:",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'self'",
        "frame-ancestors 'none'",
    )
)
FORWARDED_META: Final = {name: "HTTP_" + name.upper().replace("-", "_") for name in FORWARDED}
HEADERS: Final[dict[str, str]] = {
    "Content-Security-Policy": CONTENT_SECURITY_POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
}


def page_policy() -> str:
    """Returns the content security policy of pages with forms.

    Sign-in may redirect to the provider's page.
    """
    issuer = environment().oidc_issuer
    origin = "/".join(issuer.split("/")[:3])
    return CONTENT_SECURITY_POLICY.replace("form-action 'self'", f"form-action 'self' {origin}".rstrip())


def headers_of_all() -> dict[str, str]:
    """Returns the security headers of every answer."""
    settings = environment()
    headers = HEADERS
    if origin := settings.object_store_public:
        policy = CONTENT_SECURITY_POLICY.replace("connect-src 'self'", f"connect-src 'self' {origin}")
        headers = headers | {"Content-Security-Policy": policy}
    if settings.is_https and settings.hsts_days:
        headers = headers | {"Strict-Transport-Security": f"max-age={settings.hsts_days * 24 * 3600}"}
    return headers


class Middleware:
    """Base of middleware with a hook before the view and one after it."""

    def __init__(self, get_response: Callable[[HttpRequest], HttpResponseBase]) -> None:
        self.get_response = get_response

    def __call__(self, request: HttpRequest) -> HttpResponseBase:
        """Calls the hooks and the view; called by Django."""
        return self.after(request, self.before(request) or self.get_response(request))

    def before(self, request: HttpRequest) -> HttpResponseBase | None:
        """Returns an answer in place of the view's, or None."""
        return None

    def after(self, request: HttpRequest, response: HttpResponseBase) -> HttpResponseBase:
        """Returns the answer, possibly changed."""
        return response


class SecurityHeaders(Middleware):
    """Adds the security headers to every answer."""

    def after(self, request: HttpRequest, response: HttpResponseBase) -> HttpResponseBase:
        """Adds the headers that the view did not set."""
        return secured(request.path_info, response)


def secured(path: str, response: HttpResponseBase) -> HttpResponseBase:
    """Adds the security headers to the answer to a request for this path."""
    if path.startswith(PAGES):
        # Under `no-referrer`, browsers send forms with `Origin: null`.
        response.headers["Referrer-Policy"] = "same-origin"
        response.headers["Content-Security-Policy"] = page_policy()
    for name, value in headers_of_all().items():
        response.headers.setdefault(name, value)
    if path.startswith(API):
        response.headers.setdefault("Cache-Control", "private, no-cache")
    return response


class Guard(Middleware):
    """Passes on requests that `guard.judge` allows; exchanges the token for the cookie."""

    def before(self, request: HttpRequest) -> HttpResponseBase | None:
        """Answers a refused request, and the local user's link, whose token is exchanged for the cookie.

        Otherwise returns None.
        """
        headers = {name: request.META[key] for name, key in FORWARDED_META.items() if key in request.META}
        client_address.set(address_of(request.META.get("REMOTE_ADDR"), headers))
        proxies.see(headers)
        if "\0" in request.path_info or "%00" in request.META.get("QUERY_STRING", ""):
            # No name may contain NUL, and PostgreSQL cannot store it.
            sentence = "An address holds no NUL character."
            return problem_response(problem(400, "bad_address", detail=sentence))
        facts = facts_of(request)
        keys = guard.keys()
        is_page = request.path_info == "/" or request.path_info.startswith("/projects/")
        link = request.method == "GET" and is_page and "token" in request.GET
        if link and not environment().is_team and keys.is_token(request.GET["token"]):
            refusal = guard.check(guard.Facts("GET", facts.host, cookie=keys.cookie_value))
            return refuse(request, refusal) if refusal else exchange(request, facts.host)
        refusal = guard.check(facts)
        return refuse(request, refusal) if refusal else None


def facts_of(request: HttpRequest) -> guard.Facts:
    """Returns the facts of a request that the guard needs."""
    host = request.META.get("HTTP_HOST", "")
    scheme, _, bearer = request.META.get("HTTP_AUTHORIZATION", "").partition(" ")
    return guard.Facts(
        method=request.method or "GET",
        host=host,
        schemes=guard.schemes_of(host, request.scheme or "http"),
        origin=request.META.get("HTTP_ORIGIN"),
        fetch_site=request.META.get("HTTP_SEC_FETCH_SITE"),
        cookie=request.COOKIES.get(guard.cookie_name(host)),
        bearer=bearer if scheme.lower() == "bearer" else None,
    )


def exchange(request: HttpRequest, host: str) -> HttpResponse:
    """Sets the cookie and redirects to the same page without the token."""
    rest = {key: value for key, value in request.GET.items() if key != "token"}
    page = "/" + quote(request.path_info.strip("/"))  # one slash, so that it names no other host
    response = HttpResponseRedirect(page + (f"?{urlencode(rest)}" if rest else ""))
    response.set_cookie(
        guard.cookie_name(host), guard.keys().cookie_value, httponly=True, samesite="Strict", path="/"
    )
    response.headers["Cache-Control"] = "no-store"
    return response


def refuse(request: HttpRequest, refusal: guard.Refusal) -> HttpResponse:
    """Returns the answer to a refused request: HTML for a browser, a problem document for a program."""
    document = problem(refusal.status, refusal.code, detail=refusal.detail, hint=refusal.hint)
    if "text/html" not in request.META.get("HTTP_ACCEPT", "") or request.path_info.startswith(API):
        return problem_response(document)
    response = render(request, "config/refused.html", {"problem": document}, status=refusal.status)
    response.headers["Cache-Control"] = "no-store"
    return response
