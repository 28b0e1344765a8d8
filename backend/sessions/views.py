"""Views of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from drf_spectacular.utils import extend_schema
from rest_framework.response import Response
from rest_framework.views import APIView

from backend.accounts.api.requests import user_of
from backend.sessions import queries
from backend.sessions.lifecycle import attaching, writes
from backend.sessions.serializers import (
    AttachSerializer,
    OwnSessionListSerializer,
    SessionSerializer,
    presented,
    presented_own,
)

if TYPE_CHECKING:
    from uuid import UUID

    from rest_framework.request import Request


class ProjectSession(APIView):
    """The session of a project."""

    expensive = ("POST",)

    @extend_schema(operation_id="start_session", request=None, responses=SessionSerializer, tags=["sessions"])
    def post(self, request: Request, project_id: UUID) -> Response:
        """Starts an executor for the project, or returns the session that already runs."""
        return Response(presented(writes.start_session(project_id, acting_user=user_of(request))))


class OwnSessions(APIView):
    """The sessions of the user."""

    @extend_schema(operation_id="list_sessions", responses=OwnSessionListSerializer, tags=["sessions"])
    def get(self, request: Request) -> Response:
        """Lists the user's sessions that wait, start or run, so that one may be ended."""
        return Response({"items": [presented_own(each) for each in queries.sessions_of(user_of(request))]})


class AttachedSessions(APIView):
    """Sessions that follow programs outside."""

    expensive = ("POST",)

    @extend_schema(
        operation_id="attach", request=AttachSerializer, responses=SessionSerializer, tags=["sessions"]
    )
    def post(self, request: Request) -> Response:
        """Starts a session that follows a program by Groot2's protocol, or returns the one that does."""
        wanted = AttachSerializer(data=request.data)
        wanted.is_valid(raise_exception=True)
        session = attaching.attach(wanted.validated_data["address"], acting_user=user_of(request))
        return Response(presented(session))


class PreparedAttachedSession(APIView):
    """The session that will follow a program outside."""

    expensive = ("POST",)

    @extend_schema(operation_id="prepare_attach", request=None, responses={204: None}, tags=["sessions"])
    def post(self, request: Request) -> Response:
        """Starts its processes while the user still writes the address; they end soon if nobody attaches."""
        user_of(request)
        attaching.prepare()
        return Response(status=204)


class OneSession(APIView):
    """One session."""

    @extend_schema(operation_id="get_session", responses=SessionSerializer, tags=["sessions"])
    def get(self, request: Request, session_id: UUID) -> Response:
        """Returns the session, with its state: whether it starts, runs, failed or has ended."""
        return Response(presented(writes.refresh(queries.session(session_id, user=user_of(request)))))

    @extend_schema(operation_id="end_session", responses={204: None}, tags=["sessions"])
    def delete(self, request: Request, session_id: UUID) -> Response:
        """Ends the executor with all its processes."""
        writes.end_session(queries.session(session_id, user=user_of(request)))
        return Response(status=204)
