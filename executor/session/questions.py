"""Requests to a child on behalf of a client.

They are open until the child answers, ends, or takes too long.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor import messages

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.session.events import Kind
    from executor.session.stage import Stage

__all__ = ["Question", "Questions", "answer", "answer_late"]

ANSWER_S: Final = 5.0


@dataclass(frozen=True)
class Question:
    """A command of a client that a child has to answer.

    Attributes:
        then: is called if the command succeeds.
        refused: is called if the child refuses it.
        late: is called if the child does not answer. With it the session keeps what is asked, so that the
            command also succeeds then.
    """

    client: str
    request: str
    child: tuple[Kind, int]
    until_s: float
    topic: str = ""
    then: Callable[[], None] | None = None
    refused: Callable[[], None] | None = None
    late: Callable[[], None] | None = None


class Questions:
    """The open questions, by the token that the child repeats in its answer."""

    def __init__(self) -> None:
        self._questions: dict[str, Question] = {}
        self._count = 0

    def token(self) -> str:
        """Returns a new token."""
        self._count += 1
        return f"q{self._count}"

    def add(  # noqa: PLR0913 - one question
        self,
        client: str,
        request: str,
        child: tuple[Kind, int],
        now_s: float,
        *,
        topic: str = "",
        patience_s: float = ANSWER_S,
        then: Callable[[], None] | None = None,
        refused: Callable[[], None] | None = None,
        late: Callable[[], None] | None = None,
    ) -> str:
        """Stores a question; returns its token."""
        token = self.token()
        until_s = now_s + patience_s
        self._questions[token] = Question(client, request, child, until_s, topic, then, refused, late)
        return token

    def asker(self, token: str | None) -> str | None:
        """Returns the client whose question has this token, or None."""
        question = None if token is None else self._questions.get(token)
        return None if question is None else question.client

    def answered(self, token: str) -> Question | None:
        """Removes and returns the question with this token; None if it is not open (any more)."""
        return self._questions.pop(token, None)

    def expired(self, now_s: float) -> list[Question]:
        """Removes and returns the questions whose answer is too late."""
        return self._take(lambda question: now_s >= question.until_s)

    def orphaned(self, child: tuple[Kind, int]) -> list[Question]:
        """Removes and returns the questions to a child that has ended."""
        return self._take(lambda question: question.child == child)

    @property
    def deadline_s(self) -> float | None:
        """The time at which the next question expires; None if none is open."""
        return min((question.until_s for question in self._questions.values()), default=None)

    def _take(self, which: Callable[[Question], bool]) -> list[Question]:
        tokens = [token for token, question in self._questions.items() if which(question)]
        return [self._questions.pop(token) for token in tokens]


def answer(stage: Stage, question: Question, error: messages.Error | None) -> None:
    """Replies to the client of a question, after its child answered or can no longer answer."""
    if error is None:
        if question.then is not None:
            question.then()
        stage.output.send(question.client, messages.Ack(), question.request)
        return
    if question.topic:
        stage.clients.echo(question.client, question.topic, 0.0)
    if question.refused is not None:
        question.refused()
    stage.output.send(question.client, error, question.request)


def answer_late(stage: Stage, questions: list[Question], code: str, reason: str, why: str = "") -> None:
    """Replies to the clients of questions that their child did not answer: with an error, if it matters."""
    for question in questions:
        if question.late is not None:
            question.late()
            stage.output.send(question.client, messages.Ack(), question.request)
            continue
        answer(stage, question, messages.Error(code, why or f"The {question.child[0]} {reason}."))
