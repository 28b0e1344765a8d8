"""The work of administrators on their pages and in the terminal."""

from __future__ import annotations

from backend.accounts.models import User
from backend.accounts.signals_out import account_leaves
from tests.backend.accounts.test_sharing import project_of


def test_an_administrator_deletes_an_account_as_its_user_would(person):
    ada, olga = person("ada", is_admin=True), person("olga")
    project_of(olga)
    left = []
    account_leaves.connect(lambda sender, user, **_: left.append(user.username), weak=False)
    ada.form(f"/admin/accounts/user/{olga.user.pk}/delete/", post="yes")
    assert left == ["olga"]
    assert not User.objects.filter(username="olga").exists()
    answer = ada.form(f"/admin/accounts/user/{ada.user.pk}/delete/", post="yes")
    assert b"only administrator" in ada.page(answer["Location"]).content
    chosen = {"action": "delete_selected", "_selected_action": str(ada.user.pk), "post": "yes"}
    ada.form("/admin/accounts/user/", **chosen)
    assert User.objects.filter(username="ada").exists()


def test_each_page_warns_where_users_run_as_the_server(person, settings_of):
    ada = person("ada", is_admin=True)
    for page in ("/admin/", "/admin/mail/", "/admin/accounts/user/"):
        settings_of(launcher="process")
        assert b"BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER" in ada.page(page).content
        settings_of(launcher="docker")
        assert b"BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER" not in ada.page(page).content
