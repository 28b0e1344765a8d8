"""The administration pages: users with their limits and disk use, groups, invitations, audit log, mail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from allauth.account.decorators import secure_admin_login
from django.contrib import admin, messages
from django.contrib.auth.admin import UserAdmin
from django.core.mail import send_mail
from django.db import transaction
from django.db.models import Count, Q, Sum
from django.http import HttpRequest, HttpResponse, HttpResponseRedirect
from django.template.defaultfilters import filesizeformat
from django.template.response import TemplateResponse
from django.urls import path

from backend.accounts.audit import note
from backend.accounts.models import AuditEntry, Group, GroupMember, Invitation, User
from backend.accounts.sign_in import passwords
from backend.accounts.writes import LastAdministratorError, delete_account
from backend.config.environment import environment

if TYPE_CHECKING:
    from collections.abc import Sequence

    from django.db.models import Model, QuerySet


class Site(admin.AdminSite):
    """Django's administration site.

    Administrators sign in like all other users, including the second factor.
    """

    site_header = "BT Studio – administration"
    site_title = "BT Studio"
    index_title = "This server"
    enable_nav_sidebar = True

    def get_urls(self) -> list[Any]:
        """Adds the page that sends a test mail."""
        return [path("mail/", self.admin_view(self.mail), name="mail"), *super().get_urls()]

    def each_context(self, request: HttpRequest) -> dict[str, Any]:
        """Adds whether a warning about the launcher is shown on each page."""
        return super().each_context(request) | {"users_run_as_server": environment().users_run_as_server}

    def mail(self, request: HttpRequest) -> HttpResponse:
        """Sends a mail to the administrator who presses the button."""
        if request.method == "POST":
            self._send(request)
            return HttpResponseRedirect(request.path)
        values = {
            **self.each_context(request),
            "title": "Mail",
            "sends_mail": bool(environment().smtp_url.get_secret_value()),
            "sender": environment().mail_from,
        }
        return TemplateResponse(request, "admin/mail.html", values)

    @staticmethod
    def _send(request: HttpRequest) -> None:
        user = request.user
        if not isinstance(user, User) or not user.email:
            messages.error(request, "Your account has no e-mail address to send to.")
            return
        try:
            send_mail("BT Studio: test", "The mail server works.", None, [user.email])
        except OSError as error:
            messages.error(request, f"The mail server refused: {error}")
        else:
            note("mail.test", actor=user)
            messages.success(request, f"Sent to {user.email}.")


site = Site(name="admin")
site.login = secure_admin_login(site.login)  # type: ignore[method-assign]


class Audited(admin.ModelAdmin):  # type: ignore[type-arg]
    """Base class that writes an administrator's changes to the audit log."""

    def log_addition(self, request: HttpRequest, obj: Any, message: Any) -> Any:
        """Writes to the audit log after an object was added."""
        self._note("add", request, obj)
        return super().log_addition(request, obj, message)

    def log_change(self, request: HttpRequest, obj: Any, message: Any) -> Any:
        """Writes to the audit log after a change: the names of the fields, never their values."""
        changed = [row["changed"].get("fields", []) for row in message if "changed" in row]
        self._note("change", request, obj, fields=[str(name) for names in changed for name in names])
        return super().log_change(request, obj, message)

    def log_deletions(self, request: HttpRequest, queryset: QuerySet[Any]) -> Any:
        """Writes to the audit log before objects are deleted."""
        for row in queryset:
            self._note("delete", request, row)
        return super().log_deletions(request, queryset)

    @staticmethod
    def _note(verb: str, request: HttpRequest, row: Model, fields: Sequence[str] = ()) -> None:
        actor = request.user if isinstance(request.user, User) else None
        kind = row._meta.model_name
        note(f"admin.{verb}_{kind}", actor=actor, subject=str(row), subject_id=row.pk, fields=[*fields])


class ReadOnly(admin.ModelAdmin):  # type: ignore[type-arg]
    """Base class that shows objects without any permission to change them."""

    def has_add_permission(self, request: HttpRequest, obj: Any = None) -> bool:
        return False

    def has_change_permission(self, request: HttpRequest, obj: Any = None) -> bool:
        return False

    def has_delete_permission(self, request: HttpRequest, obj: Any = None) -> bool:
        return False


class Users(Audited, UserAdmin):  # type: ignore[type-arg]
    """Accounts, their rights, limits and disk use."""

    list_display = ("username", "email", "role", "is_active", "projects_kept", "room_used", "last_login")
    list_filter = ("is_active", "is_teacher", "is_staff", "is_superuser", "is_exempt")
    actions = ("make_password_link", "deactivate")
    fieldsets = (
        (None, {"fields": ("username", "password")}),
        ("Person", {"fields": ("first_name", "last_name", "email")}),
        ("Rights", {"fields": ("is_active", "is_teacher", "is_staff", "is_superuser")}),
        ("Limits", {"fields": ("max_bytes", "max_projects", "is_exempt")}),
        ("Dates", {"fields": ("last_login", "date_joined")}),
    )
    readonly_fields = ("last_login", "date_joined")

    def get_queryset(self, request: HttpRequest) -> QuerySet[User]:
        """Returns the users, each with the number of projects and the stored bytes."""
        kept = Q(projects__deleted_at=None)
        rows: QuerySet[User] = super().get_queryset(request)
        return rows.annotate(kept=Count("projects", filter=kept), used=Sum("projects__size", filter=kept))

    def delete_model(self, request: HttpRequest, obj: User) -> None:
        """Deletes a user in the same way as the user's own page: running robots of the user end too."""
        delete_account(obj)

    def delete_queryset(self, request: HttpRequest, queryset: QuerySet[User]) -> None:
        """Deletes several users; refuses all of them if no administrator would be left."""
        with transaction.atomic():
            for user in queryset:
                delete_account(user)

    def get_deleted_objects(
        self, objs: Sequence[User] | QuerySet[User], request: HttpRequest
    ) -> tuple[list[str], dict[str, int], set[str], list[str]]:
        """Shows how many projects are deleted with each user, in place of a list of all their files.

        Sessions and invitations of the user are deleted too, although they cannot be deleted separately.
        """
        rows = list(objs)
        lines = [f"{row.username}, with all projects ({row.projects.count()})" for row in rows]
        return lines, {"accounts": len(rows)}, set(), []

    def delete_view(self, request: HttpRequest, object_id: str, extra_context: Any = None) -> HttpResponse:
        """Shows the reason if the last administrator cannot be deleted."""
        try:
            return super().delete_view(request, object_id, extra_context)
        except LastAdministratorError as error:
            messages.error(request, f"{error.detail} {error.hint}")
            return HttpResponseRedirect(request.path)

    def response_action(self, request: HttpRequest, queryset: QuerySet[User]) -> HttpResponse | None:  # type: ignore[override]
        """Shows the reason if the last administrator is among several users to delete."""
        try:
            return super().response_action(request, queryset)
        except LastAdministratorError as error:
            messages.error(request, f"{error.detail} {error.hint}")
            return HttpResponseRedirect(request.get_full_path())

    @admin.display(description="role")
    def role(self, row: User) -> str:
        """Returns the user's highest right."""
        return "administrator" if row.is_superuser else "teacher" if row.is_teacher else "user"

    @admin.display(description="projects", ordering="kept")
    def projects_kept(self, row: Any) -> int:
        return int(row.kept)

    @admin.display(description="room", ordering="used")
    def room_used(self, row: Any) -> str:
        """Returns the size of the user's current files as text."""
        return str(filesizeformat(row.used or 0))

    @admin.action(description="Make a link that sets a new password")
    def make_password_link(self, request: HttpRequest, rows: QuerySet[User]) -> None:
        """Makes a link that sets a new password, for users without e-mail.

        The link works once, for three days.
        """
        for user in rows:
            note("password.link", actor=_actor(request), subject=user.username, subject_id=user.pk)
            messages.info(request, f"{user.username}: {passwords.link(user)}")

    @admin.action(description="Deactivate (projects are kept)")
    def deactivate(self, request: HttpRequest, rows: QuerySet[User]) -> None:
        """Deactivates accounts; all their rights end immediately."""
        for user in rows.exclude(pk=request.user.pk or 0):
            user.is_active = False
            user.save(update_fields=["is_active"])
            note("account.deactivate", actor=_actor(request), subject=user.username, subject_id=user.pk)


def _actor(request: HttpRequest) -> User | None:
    return request.user if isinstance(request.user, User) else None


class Members(admin.TabularInline):  # type: ignore[type-arg]
    """The members of a group."""

    model = GroupMember
    extra = 0
    autocomplete_fields = ("user",)


class Groups(Audited):
    """Groups of users, such as classes."""

    list_display = ("name", "owner", "created_at")
    search_fields = ("name", "owner__username")
    autocomplete_fields = ("owner",)
    inlines = (Members,)


class Invitations(ReadOnly):
    """Invitation links, valid and used ones."""

    list_display = ("created_by", "group", "created_at", "expires_at", "uses", "max_uses", "revoked_at")
    list_filter = ("group",)


class AuditLog(ReadOnly):
    """Entries of the audit log, read-only."""

    list_display = ("at", "actor_name", "action", "subject", "address")
    list_filter = ("action",)
    search_fields = ("actor_name", "subject", "subject_id")
    date_hierarchy = "at"
    show_full_result_count = False


REGISTERED: Sequence[tuple[type[Model], type[Any]]] = (
    (User, Users),
    (Group, Groups),
    (Invitation, Invitations),
    (AuditEntry, AuditLog),
)
for model, page in REGISTERED:
    site.register(model, page)
