"""The format of `evaluations/<name>.yaml`: what varies, which faults occur, and what counts as success."""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal, Self

from pydantic import Field, StringConstraints, field_validator, model_validator

from executor.universes.strict import Strict

FOLDER: Final = "evaluations/"
ENDING: Final = ".yaml"
FORMAT: Final = "bt-studio/evaluation"
LAST_SEED: Final = 2**53 - 1  # the largest number that JSON of every language keeps
MOST_RUNS: Final = 100_000

Finite = Annotated[float, Field(allow_inf_nan=False, ge=-1e6, le=1e6)]
NotNegative = Annotated[float, Field(allow_inf_nan=False, ge=0, le=1e6)]
Share = Annotated[float, Field(allow_inf_nan=False, ge=0, le=1)]
Word = Annotated[str, StringConstraints(min_length=1, max_length=300)]
Range = tuple[Finite, Finite]
Pose6 = tuple[Finite, Finite, Finite, Finite, Finite, Finite]
Measure = Literal["time_to_success_s", "path_length_m", "smallest_clearance_m", "mean_speed_m_s", "energy_j"]


def _ordered(range_: Range) -> Range:
    if range_[0] > range_[1]:
        raise ValueError("a range [a, b] starts with its lower bound")
    return range_


class Draw(Strict):
    """The draw of one value: `[a, b]` is uniform.

    `normal` is [mean, standard deviation] and needs `clip`, to which values beyond it are moved. `choice`
    takes each of its values equally often. A pose takes an `area`, over which x and y are uniform, and may
    take a range of `yaw` in rad.
    """

    uniform: Range | None = Field(default=None, description="Equally likely from a to b; `[a, b]` for short.")
    normal: Range | None = Field(default=None, description="Mean and standard deviation; needs `clip`.")
    clip: Range | None = Field(default=None, description="Values of `normal` beyond it move to its ends.")
    choice: tuple[bool | int | Finite | Word, ...] | None = Field(
        default=None, min_length=1, max_length=1000, description="Each value equally often."
    )
    area: Word | None = Field(default=None, description="Of a pose: x and y are uniform over this area.")
    yaw: Range | None = Field(default=None, description="With `area`: a range in rad, uniform.")

    @model_validator(mode="before")
    @classmethod
    def _lists_are_uniform(cls, value: Any) -> Any:
        return {"uniform": value} if isinstance(value, list) else value

    @model_validator(mode="after")
    def _is_one_kind(self) -> Self:
        kinds = [name for name in ("uniform", "normal", "choice", "area") if getattr(self, name) is not None]
        if len(kinds) != 1:
            raise ValueError("write [a, b], or one of `normal`, `choice` and `area`")
        for name, owner in (("clip", "normal"), ("yaw", "area")):
            if getattr(self, name) is not None and kinds[0] != owner:
                raise ValueError(f"`{name}` belongs to `{owner}`")
        if self.normal is not None and (self.clip is None or self.normal[1] < 0):
            raise ValueError(
                "`normal: [mean, deviation]` needs `clip: [a, b]`, and a deviation of at least 0"
            )
        for range_ in (self.uniform, self.clip, self.yaw):
            if range_ is not None:
                _ordered(range_)
        return self


class Until(Strict):
    """Runs until the interval of the rate is narrow enough: at most `half_width` to each side."""

    half_width: float = Field(gt=0, lt=0.5, description="Half the width of the interval at which it ends.")
    confidence: float = Field(default=0.95, ge=0.5, le=0.999, description="Of the interval.")
    at_most: int = Field(ge=50, le=MOST_RUNS, description="The largest number of runs.")


FAULT_FIELDS: Final[dict[str, tuple[str, ...]]] = {
    "sensor_silent": ("sensor",),
    "sensor_frozen": ("sensor",),
    "sensor_noise": ("sensor", "factor"),
    "topic_delay": ("topic", "delay_s"),
    "topic_drop": ("topic", "share"),
    "wheel_slip": ("wheel", "factor"),
    "wheel_stuck": ("wheel",),
    "kidnap": ("area | pose",),
    "push": ("impulse_n_s", "direction"),
    "light_change": ("factor",),
    "action_raises": ("node",),
}
"""The fields of each kind of fault, all of which it needs."""
_OWN_FIELDS: Final = ("sensor", "topic", "wheel", "node", "factor", "delay_s", "share", "area", "pose",
                      "impulse_n_s", "direction")  # fmt: skip


class Fault(Strict):
    """A fault: from `at_s`, for `for_s` (until the end without it), with a probability.

    `at_s` and `for_s` are numbers, or ranges from which they are drawn. It happens to the first robot, or to
    `robot`.
    """

    kind: Literal[
        "sensor_silent",
        "sensor_frozen",
        "sensor_noise",
        "topic_delay",
        "topic_drop",
        "wheel_slip",
        "wheel_stuck",
        "kidnap",
        "push",
        "light_change",
        "action_raises",
    ] = Field(description="What goes wrong.")
    at_s: NotNegative | tuple[NotNegative, NotNegative] = Field(
        default=0.0, description="When it begins; a range is drawn from."
    )
    for_s: NotNegative | tuple[NotNegative, NotNegative] | None = Field(
        default=None, description="How long it takes; until the end without it."
    )
    probability: Share = Field(default=1.0, description="The share of the runs in which it happens.")
    robot: Word | None = Field(default=None, description="The id of another robot than the first.")
    sensor: Word | None = Field(default=None, description="The name of a sensor of the robot.")
    topic: Word | None = Field(default=None, description="A topic of a sensor, of odometry, or `/cmd_vel`.")
    wheel: Word | None = Field(default=None, description="The joint of a wheel.")
    node: Word | None = Field(default=None, description="Name or id of a leaf in the trees.")
    factor: NotNegative | None = Field(default=None, description="By what noise, friction or light changes.")
    delay_s: NotNegative | None = Field(default=None, description="By how much messages come later.")
    share: Share | None = Field(default=None, description="The share of the messages that is lost.")
    area: Word | None = Field(default=None, description="Where the robot is put, at a free place.")
    pose: Pose6 | None = Field(default=None, description="x, y, z in m, roll, pitch, yaw in rad.")
    impulse_n_s: NotNegative | None = Field(default=None, description="The push, at the centre of mass.")
    direction: tuple[Finite, Finite] | None = Field(
        default=None, description="[x, y] in the frame of the world; its length does not matter."
    )

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        wanted = FAULT_FIELDS[self.kind]
        allowed = {name for field in wanted for name in field.split(" | ")}
        for name in _OWN_FIELDS:
            if getattr(self, name) is not None and name not in allowed:
                raise ValueError(f"`{name}` has no place in a {self.kind}")
        for field in wanted:
            if sum(getattr(self, name) is not None for name in field.split(" | ")) != 1:
                raise ValueError(f"a {self.kind} needs `{field}`")
        if self.direction is not None and not any(self.direction):
            raise ValueError("a `direction` [x, y] is not [0, 0]")
        for range_ in (self.at_s, self.for_s):
            if isinstance(range_, tuple):
                _ordered(range_)
        return self

    @property
    def address(self) -> str:
        """The address by which the fault is drawn; equal faults are numbered by their order."""
        target = self.sensor or self.topic or self.wheel or self.node or ""
        return ".".join(part for part in ("faults", self.kind, self.robot or "", target) if part)


class Reach(Strict):
    """The robot stands in an area, within a time if one is given."""

    area: Word = Field(description="The robot's middle has to be in this area of the universe.")
    within_s: NotNegative | None = Field(default=None, description="In so much time from the start.")


class Never(Strict):
    """An event that must not happen: a collision, or something closer than a distance."""

    collision: Literal[True] | None = Field(
        default=None,
        description="Driving into anything but the floor; being hit is none. `never: collision` for short.",
    )
    closer_than_m: NotNegative | None = Field(default=None, description="Something is closer than this.")
    to: Word = Field(
        default="anything", description="`anything`, `models`, `actors`, `robots`, or the id of one."
    )

    @model_validator(mode="before")
    @classmethod
    def _collision_is_a_word(cls, value: Any) -> Any:
        return {"collision": True} if value == "collision" else value

    @model_validator(mode="after")
    def _is_one_kind(self) -> Self:
        if (self.collision is None) == (self.closer_than_m is None):
            raise ValueError("write `never: collision`, or `never: {closer_than_m: …, to: …}`")
        if self.collision is not None and "to" in self.model_fields_set:
            raise ValueError("`to` belongs to `closer_than_m`")
        return self


class Criterion(Strict):
    """One item of `success`: a goal (`reach`, `visit`, `tree`), a `never`, or a function of the project.

    `python` names a function as `file.py:function`, beside the evaluation; `at_least` and `at_most` are the
    thresholds of the numbers that it returns.
    """

    reach: Reach | None = Field(default=None, description="A goal: the robot gets into an area.")
    never: Never | None = Field(default=None, description="What must not happen.")
    visit: tuple[Word, ...] | None = Field(
        default=None, min_length=1, max_length=100, description="A goal: the robot was in each of the areas."
    )
    in_order: bool = Field(default=False, description="With `visit`: in this order.")
    tree: Literal["SUCCESS", "FAILURE"] | None = Field(
        default=None, description="A goal: the tree ends with this result."
    )
    within_s: NotNegative | None = Field(
        default=None, description="With `visit` and `tree`: in so much time from the start."
    )
    python: (
        Annotated[str, StringConstraints(pattern=r"^[\w/-]+\.py:[A-Za-z_]\w*$", max_length=200)] | None
    ) = Field(
        default=None,
        description="`file.py:function` in `evaluations/`; takes the truth of the run and returns numbers.",
    )
    at_least: dict[Word, Finite] = Field(
        default_factory=dict, description="With `python`: the smallest value of a number, by its name."
    )
    at_most: dict[Word, Finite] = Field(
        default_factory=dict, description="With `python`: the largest value of a number, by its name."
    )

    @model_validator(mode="after")
    def _is_one_kind(self) -> Self:
        kinds = ("reach", "never", "visit", "tree", "python")
        found = [name for name in kinds if getattr(self, name) is not None]
        if len(found) != 1:
            raise ValueError(f"an item is one of {', '.join(kinds)}")
        owners = {
            "in_order": ("visit",),
            "within_s": ("visit", "tree"),
            "at_least": ("python",),
            "at_most": ("python",),
        }
        for name in sorted(self.model_fields_set & owners.keys()):
            if found[0] not in owners[name]:
                raise ValueError(f"`{name}` belongs to `{'` and `'.join(owners[name])}`")
        if found[0] == "python" and not (self.at_least or self.at_most):
            raise ValueError("a `python` item needs thresholds: `at_least: {name: number}` or `at_most`")
        return self

    @property
    def kind(self) -> str:
        """The name of the kind of demand."""
        return next(k for k in ("reach", "never", "visit", "tree", "python") if getattr(self, k) is not None)

    @property
    def deadline_s(self) -> float | None:
        """The time by which a goal must be met."""
        return self.reach.within_s if self.reach is not None else self.within_s


class Judge(Strict):
    """The items of success, and the measures."""

    success: tuple[Criterion, ...] = Field(
        min_length=1, max_length=100, description="Items, all of which must hold."
    )
    measure: tuple[Measure, ...] = Field(
        default=("path_length_m",), description="What is measured until the run is decided."
    )


class Evaluation(Strict):
    """An evaluation of a project: worlds, robot, length, seeds, what varies, faults and judge."""

    format: Literal["bt-studio/evaluation"] = Field(description="Required.")
    version: Literal[1] = Field(description="Required.")
    description: str = Field(default="", max_length=10_000, description="For readers.")
    universe: Word | None = Field(default=None, description="The project's own without it.")
    robot: Word | None = Field(default=None, description="The project's own without it.")
    duration_s: float = Field(gt=0, le=36_000, description="The longest time of a run, in simulated s.")
    runs: int | None = Field(
        default=None, ge=1, le=MOST_RUNS, description="How many runs. Either `runs` or `until` is needed."
    )
    until: Until | None = Field(default=None, description="Runs until the rate is known well enough.")
    seed: int = Field(
        default=0, ge=0, le=LAST_SEED - MOST_RUNS, description="The seed of the first run; others follow."
    )
    vary: dict[Word, Draw] = Field(
        default_factory=dict, max_length=1000, description="What differs from run to run, by its address."
    )
    faults: tuple[Fault, ...] = Field(default=(), max_length=100, description="What goes wrong.")
    judge: Judge = Field(description="What counts as success, and what is measured.")

    @field_validator("vary", mode="before")
    @classmethod
    def _nothing_is_empty(cls, value: Any) -> Any:
        return {} if value is None else value

    @model_validator(mode="after")
    def _knows_how_many(self) -> Self:
        if (self.runs is None) == (self.until is None):
            raise ValueError("write either `runs: N`, or `until: {half_width: …, at_most: …}`")
        return self

    @property
    def most_runs(self) -> int:
        """The number of runs, or the largest if it depends on their outcomes."""
        return self.runs if self.runs is not None else (self.until.at_most if self.until else 0)
