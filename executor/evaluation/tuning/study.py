"""The study: Optuna's TPE proposes values, the evaluation rates them. It lives in a file of SQLite.

The sampler is made again for each trial with a seed of its own, so that an interrupted study continues as if
it had not been interrupted, and the number of workers changes nothing.
"""

from __future__ import annotations

import hashlib
import math
import sys
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.tuning.space import Port, TuningError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from executor.evaluation.tuning.space import Value

FILE: Final = "study.sqlite"
ENDED: Final = "ended"
MISSING: Final = (
    "tune needs Optuna, which is not installed: {python} -m pip install 'optuna~=4.9' (the extra `tune`)"
)


@dataclass(frozen=True)
class Trial:
    """Values of the ports, and what they were rated; None if no run counted."""

    number: int
    values: dict[str, Value]
    rating: float | None


def import_optuna() -> Any:
    """Returns Optuna.

    Raises:
        TuningError: it is not installed.
    """
    try:
        import optuna  # noqa: PLC0415 - an extra
    except ImportError:
        raise TuningError(MISSING.format(python=sys.executable)) from None
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    return optuna


class Study:
    """The trials of a study; those that a file holds already are kept.

    Args:
        folder: holds the file.
        key: what the study is of (project, evaluation, ports, objective); another one is another study.
        ports: the ports.
        maximise: whether more is better.
        seed: the seed of the sampler.

    Raises:
        TuningError: Optuna is not installed, or the folder can hold no study.
    """

    def __init__(self, folder: Path, key: str, ports: Sequence[Port], *, maximise: bool, seed: int) -> None:
        self._optuna = import_optuna()
        self._ports = ports
        self._seed = seed
        self._maximise = maximise
        from sqlalchemy.exc import SQLAlchemyError  # noqa: PLC0415 - Optuna brings it

        failures = (OSError, SQLAlchemyError, self._optuna.exceptions.StorageInternalError)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._open(folder / FILE, key)
        except failures as error:
            why = str(error).partition("\n")[0]
            raise TuningError(
                f"{folder / FILE}: no study can be kept here (name another --report): {why}"
            ) from error

    def _open(self, file: Path, key: str) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self._storage = self._optuna.storages.RDBStorage(f"sqlite:///{file}")
            self._study = self._optuna.create_study(
                storage=self._storage,
                study_name=key,
                direction="maximize" if self._maximise else "minimize",
                load_if_exists=True,
            )

    @property
    def trials(self) -> list[Trial]:
        """The trials that have ended, in their order."""
        ended = [each for each in self._study.get_trials(deepcopy=False) if each.user_attrs.get(ENDED)]
        return [
            Trial(number, dict(each.params), each.value if each.state.name == "COMPLETE" else None)
            for number, each in enumerate(ended)
        ]

    def run(
        self,
        count: int,
        rate: Callable[[dict[str, Value]], float | None],
        told: Callable[[Trial], None] = lambda _: None,
    ) -> None:
        """Runs trials until the study has so many.

        Args:
            count: the number of trials, with those that it has.
            rate: rates values; None if they cannot be rated.
            told: called with each trial that has ended.
        """
        while (number := len(self.trials)) < count:
            self._study.sampler = self._optuna.samplers.TPESampler(seed=sampler_seed(self._seed, number))
            asked = self._study.ask()
            values = {port.address: _suggest(asked, port) for port in self._ports}
            rating = rate(values)
            asked.set_user_attr(ENDED, True)  # noqa: FBT003 - a trial that was interrupted has it not
            if rating is None:
                self._study.tell(asked, state=self._optuna.trial.TrialState.FAIL)
            else:
                self._study.tell(asked, rating)
            told(Trial(number, values, rating))

    def best(self, count: int) -> list[Trial]:
        """Returns the best trials with values of their own, the best one first."""
        sign = -1 if self._maximise else 1
        rated = [(sign * each.rating, each.number, each) for each in self.trials if each.rating is not None]
        ordered = [trial for _, _, trial in sorted(rated, key=lambda each: each[:2])]
        found: dict[tuple[tuple[str, Value], ...], Trial] = {}
        for trial in ordered:
            found.setdefault(tuple(sorted(trial.values.items())), trial)
        return list(found.values())[:count]

    def close(self) -> None:
        """Closes the file."""
        self._storage.remove_session()
        self._storage.engine.dispose()


def sampler_seed(seed: int, number: int) -> int:
    """Returns the seed of the sampler for one trial."""
    return int.from_bytes(hashlib.sha256(f"{seed} {number}".encode()).digest()[:4], "big")


def _suggest(trial: Any, port: Port) -> Value:
    if port.whole:
        return int(trial.suggest_int(port.address, math.ceil(port.low), math.floor(port.high)))
    return float(trial.suggest_float(port.address, port.low, port.high))
