"""Adapts allauth to this server: who may sign up, the address of a client, and the targets of links."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from allauth.account.adapter import DefaultAccountAdapter
from allauth.socialaccount.adapter import DefaultSocialAccountAdapter
from django.core.exceptions import ValidationError

from backend.accounts import invitations
from backend.accounts.audit import client_address
from backend.accounts.sign_in.attempts import Attempt, bounds, browser_of, forget, remember
from backend.accounts.texts import text
from backend.config.environment import environment

if TYPE_CHECKING:
    from django.http import HttpRequest, HttpResponse

    from backend.accounts.sign_in.attempts import Bound


def domain_is_allowed(email: str) -> bool:
    """Returns whether `BT_STUDIO_ALLOWED_EMAIL_DOMAINS` permits this address to sign up."""
    domains = environment().allowed_email_domains
    return not domains or email.rpartition("@")[2].lower() in domains


class AccountAdapter(DefaultAccountAdapter):  # type: ignore[misc]
    """Sign-in with name or e-mail and a password."""

    def is_open_for_signup(self, request: HttpRequest) -> bool:
        """Returns whether this visitor may sign up: with an invitation, or if the administrator allows it."""
        return environment().registration == "open" or invitations.of_browser(request) is not None

    def clean_email(self, email: str) -> str:
        """Checks the domain of the address, unless the user has an invitation."""
        if not domain_is_allowed(email) and invitations.of_browser(self.request) is None:
            domains = ", ".join(environment().allowed_email_domains)
            raise ValidationError(text("domain_refused", domains=domains))
        return str(super().clean_email(email))

    def get_client_ip(self, request: HttpRequest) -> str:
        """Returns the address that the guard determined, which respects trusted proxies."""
        return client_address.get() or "0.0.0.0"  # noqa: S104 - no address to listen on

    def pre_authenticate(self, request: HttpRequest, **credentials: Any) -> None:
        """Refuses a sign-in after too many wrong passwords.

        The counts of allauth itself would also lock out other users.
        """
        self._attempt = Attempt(self._bounds(request, credentials))
        if not self._attempt.is_allowed:
            raise self.validation_error("too_many_login_attempts")

    def _rollback_login_failed_rl_usage(self) -> None:
        """Removes the attempt from the counts; called after a correct password."""
        self._attempt.take_back()

    def _delete_login_attempts_cached_email(self, request: HttpRequest, **credentials: Any) -> None:
        """Resets the counts of the account; called after a new password was set."""
        forget(self._bounds(request, credentials))
        super()._delete_login_attempts_cached_email(request, **credentials)

    def _bounds(self, request: HttpRequest, credentials: dict[str, Any]) -> tuple[Bound, ...]:
        from backend.accounts.writes import user_named  # noqa: PLC0415 - models are not loaded yet above

        typed = str(credentials.get("email") or credentials.get("username") or "").strip()
        user = user_named(typed) if typed else None
        account = user.pk if user is not None else f"“{typed.casefold()}”"
        return bounds(account, client_address.get(), browser_of(request))

    def post_login(self, request: HttpRequest, user: Any, **options: Any) -> HttpResponse:
        """Marks the browser as known to the account after a sign-in."""
        response: HttpResponse = super().post_login(request, user, **options)
        remember(request, response, user.pk)
        return response

    def authentication_failed(self, request: HttpRequest, **credentials: Any) -> None:
        """Writes failed sign-ins to the log."""
        from backend.accounts.audit import note  # noqa: PLC0415 - models are not loaded yet above

        name = str(credentials.get("username") or credentials.get("email") or "")
        note("login.failed", actor=None, actor_name=name)
        super().authentication_failed(request, **credentials)

    def send_mail(self, template_prefix: str, email: str, context: dict[str, Any]) -> None:
        """Sends a mail; if there is no mail server, shows in the page that no mail is sent."""
        if not environment().smtp_url.get_secret_value():
            return
        super().send_mail(template_prefix, email, context)

    def is_safe_url(self, url: str) -> bool:
        """Returns whether the URL is a path on this server."""
        return url.startswith("/") and not url.startswith(("//", "/\\")) and "\\" not in url


class SocialAccountAdapter(DefaultSocialAccountAdapter):  # type: ignore[misc]
    """Sign-in by a university's OpenID Connect provider."""

    def is_open_for_signup(self, request: HttpRequest, sociallogin: Any) -> bool:
        """Allows users of the provider to sign up, within the list of domains."""
        return domain_is_allowed(sociallogin.user.email or "") or invitations.of_browser(request) is not None
