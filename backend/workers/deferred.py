"""Answers that wait for a worker without holding the thread of their request."""

from __future__ import annotations

from concurrent.futures import wait
from typing import TYPE_CHECKING, Any, cast

from django.core import signals
from django.http import HttpResponse

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future

    from django.http import HttpRequest
    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.views import APIView


class Deferred(HttpResponse):
    """Stands for the answer of a view until its work is done.

    Args:
        view: whose answer it is; errors become answers as they do in its methods.
        request: what it answers.
        work: what it waits for.
        finish: makes the answer of the work that is done, in a thread for requests; it may defer again.
    """

    streaming = True  # there is nothing yet that a middleware could look at

    def __init__(
        self,
        view: APIView,
        request: Request,
        work: Future[Any],
        finish: Callable[[Future[Any]], HttpResponseBase],
    ) -> None:
        super().__init__()
        del self.headers["Content-Type"]
        self.work = work
        self._view, self._request, self._finish = view, request, finish

    def rest(self) -> None:
        """Gives up the connection to the database while it waits; the request and its files stay open."""
        signals.request_finished.send(sender=type(self))

    def complete(self) -> HttpResponseBase:
        """The answer, or what it waits for next; the work is waited for if it is not done."""
        wait([self.work])
        try:
            response = self._finish(self.work)
        except Exception as error:
            response = self._view.handle_exception(error)
        if not isinstance(response, Deferred):
            answer: Any = response  # DRF's stubs know its own responses only
            response = self._view.finalize_response(self._request, answer)
            if hasattr(response, "render"):
                response.render()
        ours, theirs = cast("Any", self)._resource_closers, cast("Any", response)._resource_closers
        theirs.extend(ours)  # the request is closed with its answer
        ours.clear()
        for name, value in self.headers.items():
            response.headers.setdefault(name, value)
        return response


class Waiting:
    """Middleware next to the views: completes answers for handlers that cannot wait for them."""

    def __init__(self, get_response: Callable[[HttpRequest], HttpResponseBase]) -> None:
        self._get_response = get_response

    def __call__(self, request: HttpRequest) -> HttpResponseBase:
        """Django's entry."""
        response = self._get_response(request)
        if not getattr(request, "handler_waits", False):
            while isinstance(response, Deferred):
                response = response.complete()
        return response
