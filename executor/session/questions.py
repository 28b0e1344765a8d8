"""What a child was asked on behalf of a client, until it answers, ends, or takes too long."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.session.events import Kind

__all__ = ["Question", "Questions"]

ANSWER_S: Final = 5.0


@dataclass(frozen=True)
class Question:
    """One command of a client that a child answers; `then` is done once it did what it was asked."""

    client: str
    request: str
    child: tuple[Kind, int]
    until_s: float
    topic: str = ""
    then: Callable[[], None] | None = None


class Questions:
    """The open questions by the token that the child repeats."""

    def __init__(self) -> None:
        self._questions: dict[str, Question] = {}
        self._count = 0

    def token(self) -> str:
        """Returns a token that none had before."""
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
    ) -> str:
        """Notes a question; returns its token."""
        token = self.token()
        self._questions[token] = Question(client, request, child, now_s + patience_s, topic, then)
        return token

    def asker(self, token: Any) -> str | None:
        """Returns the client whose question has this token."""
        question = self._questions.get(token)
        return None if question is None else question.client

    def answered(self, token: Any) -> Question | None:
        """Takes the question that a child answers; None if it is not open any more."""
        return self._questions.pop(token, None)

    def expired(self, now_s: float) -> list[Question]:
        """Takes the questions that waited too long."""
        return self._take(lambda question: now_s >= question.until_s)

    def orphaned(self, child: tuple[Kind, int]) -> list[Question]:
        """Takes the questions to a child that is gone."""
        return self._take(lambda question: question.child == child)

    @property
    def deadline_s(self) -> float | None:
        """When `expired` will have something to say."""
        return min((question.until_s for question in self._questions.values()), default=None)

    def _take(self, which: Callable[[Question], bool]) -> list[Question]:
        tokens = [token for token, question in self._questions.items() if which(question)]
        return [self._questions.pop(token) for token in tokens]
