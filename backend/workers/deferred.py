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
    """The answer of a view whose work is not done yet.

    Args:
        view: the view, whose handlers also convert errors of the work.
        request: the request.
        work: the future with the result of the work.
        finish: makes the answer from the result, in a request thread; it may return another Deferred.
        cancel: ends the work if the client leaves meanwhile, and nothing is finished; without it all is done.
    """

    streaming = True  # there is no content yet for a middleware

    def __init__(
        self,
        view: APIView,
        request: Request,
        work: Future[Any],
        finish: Callable[[Future[Any]], HttpResponseBase],
        *,
        cancel: Callable[[], object] | None = None,
    ) -> None:
        super().__init__()
        del self.headers["Content-Type"]
        self.work = work
        self.cancel = cancel
        self._view, self._request, self._finish = view, request, finish

    def close_with(self, close: Callable[[], object]) -> None:
        """Calls a function when the answer is closed, or when there will be none."""
        cast("Any", self)._resource_closers.append(close)

    def rest(self) -> None:
        """Releases the connection to the database during the wait; the request and its files stay open."""
        signals.request_finished.send(sender=type(self))

    def complete(self) -> HttpResponseBase:
        """Returns the answer, or another Deferred; waits for the work if it is not done."""
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
        theirs.extend(ours)  # closing the answer closes the request
        ours.clear()
        for name, value in self.headers.items():
            response.headers.setdefault(name, value)
        return response


class Waiting:
    """The innermost middleware. It completes deferred answers for handlers that cannot wait for them."""

    def __init__(self, get_response: Callable[[HttpRequest], HttpResponseBase]) -> None:
        self._get_response = get_response

    def __call__(self, request: HttpRequest) -> HttpResponseBase:
        """Calls the view and completes its answer; called by Django."""
        response = self._get_response(request)
        if not getattr(request, "handler_waits", False):
            while isinstance(response, Deferred):
                response = response.complete()
        return response
