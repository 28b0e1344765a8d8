"""Django's middleware for pages with forms leaves the API alone."""

from __future__ import annotations

import pytest
from django.http import HttpResponse
from django.test import RequestFactory

from backend.accounts.sign_in.middleware import PAGES, PageCsrf, PageSession


@pytest.mark.parametrize(
    ("path", "has_session"), [("/api/v1/projects", False), *((page, True) for page in PAGES)]
)
def test_only_pages_have_a_session(path: str, has_session: bool) -> None:
    seen = []

    def answer(request):
        seen.append(hasattr(request, "session"))
        return HttpResponse()

    PageSession(answer)(RequestFactory().get(path))
    assert seen == [has_session]


def test_only_forms_of_pages_need_a_token() -> None:
    middleware = PageCsrf(lambda request: HttpResponse())
    assert middleware.process_view(RequestFactory().post("/api/v1/projects"), None, (), {}) is None
    refused = middleware.process_view(
        RequestFactory(enforce_csrf_checks=True).post("/admin/"), lambda request: HttpResponse(), (), {}
    )
    assert refused is None or refused.status_code == 403
