# mypy: ignore-errors
# Its classes break what Python's types promise.
"""Values that users put on a blackboard and into exceptions: those of numpy, and those that do harm.

The text of this file is also the beginning of an action of a project (`hostile_action`).
"""

import array
import collections
import dataclasses
import datetime
import decimal
import enum
import fractions
import pathlib
import unittest.mock

import numpy as np


class Text(str):
    __slots__ = ()

    def __str__(self):
        raise ValueError("no text")


class Real(float):
    def __float__(self):
        raise ValueError("no number")

    def __repr__(self):
        raise ValueError("no repr")


class Whole(int):
    __str__ = __index__ = None


class Raw(bytes):
    pass


class Items(list):
    def __len__(self):
        raise ValueError("no length")

    def __iter__(self):
        raise ValueError("no items")


class Entries(dict):
    def items(self):
        raise ValueError("no items")

    values = keys = items


class Level(enum.IntEnum):
    LOW = 1


class Colour(enum.Enum):
    RED = "red"


@dataclasses.dataclass
class Pose:
    x: float
    parts: list


class Raises:
    def __repr__(self):
        raise SystemExit("no repr")

    __str__ = __hash__ = __eq__ = __reduce__ = __len__ = __iter__ = __bool__ = __format__ = __repr__


class Endless:
    def __repr__(self):
        while True:
            pass

    __str__ = __repr__


class Prints:
    def __repr__(self):
        print("a repr that prints", self.__class__)  # noqa: T201 - that is its harm
        return "printed"


class Masked:
    @property
    def __class__(self):
        raise ValueError("no class")

    def __getattr__(self, name):
        raise ValueError("no attribute")


class Other:
    def __repr__(self):
        return 5


class Deep:
    def __repr__(self):
        return repr(self)


RING = []
RING.append({"ring": RING})
CIRCLE = {}
CIRCLE["self"] = [CIRCLE]
NESTED = []
for _ in range(5_000):
    NESTED = [NESTED]

NUMPY = [
    np.float64(1.5),
    np.float32(0.25),
    np.int64(3),
    np.uint8(2),
    np.bool_(True),
    np.str_("a"),
    np.bytes_(b"a"),
]
NUMPY += [np.float64("nan"), np.float64("inf"), np.complex128(1j), np.datetime64("2026-01-01"), np.float16(1)]
NUMPY += [
    np.longdouble(1),
    np.array(2.0),
    np.zeros(3),
    np.zeros((200, 200)),
    np.array([None, RING], dtype=object),
]
NUMPY += [
    np.void(b"ab"),
    np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")]),
    np.ma.masked,
    np.random.default_rng(1),
]

VALUES = [
    *NUMPY,
    *([each] for each in NUMPY),
    *({"key": each} for each in NUMPY),
    *((each, 1) for each in NUMPY),
    {np.str_("key"): 1},
    {np.float64(1): 1},
    Text("text"),
    [Text("text")],
    {Text("key"): Text("text")},
    Real(1.5),
    Whole(7),
    Raw(b"raw"),
    Items([1, Real(2)]),
    Entries(a=Whole(1)),
    Level.LOW,
    Colour.RED,
    Pose(np.float64(1), [np.float64(2)]),
    Pose(1.0, RING),
    Pose(Raises(), [Endless()]),
    collections.namedtuple("Pair", "a b")(1, Raises()),
    collections.deque([1, Raises()]),
    collections.OrderedDict(a=Endless()),
    collections.defaultdict(list, a=[Raises()]),
    collections.Counter("aab"),
    Raises(),
    [Raises()],
    {"key": [Raises()]},
    Endless(),
    [Endless()] * 20,
    Other(),
    Prints(),
    [Prints()],
    Masked(),
    [Masked(), {"key": Masked()}],
    Deep(),
    unittest.mock.Mock(spec=float),
    unittest.mock.MagicMock(spec=str),
    RING,
    CIRCLE,
    NESTED,
    10**30,
    -(2**64),
    10**6_000,
    5e-324,
    float("nan"),
    "x" * 3_000_000,
    b"x" * 3_000_000,
    bytearray(5),
    memoryview(b"abc"),
    list(range(200_000)),
    set(range(5_000)),
    frozenset({"a"}),
    {str(number): number for number in range(100_000)},
    "\ud800 half a character",
    ["\udc80"],
    {"\udfff": 1},
    "\x00\x1b[2J\u2028\U0001f600",
    array.array("d", [1.0] * 30),
    datetime.datetime(2026, 1, 1),
    decimal.Decimal("1.5"),
    fractions.Fraction(1, 3),
    pathlib.Path("a"),
    range(10**12),
    slice(1),
    type,
    Raises,
    len,
    lambda: None,
    (each for each in ()),
    NotImplemented,
    ...,
    ValueError("x"),
    1j,
    object(),
    None,
    True,
]


class TextRaisesError(Exception):
    def __str__(self):
        raise SystemExit("no text")


class TextEndlessError(Exception):
    def __str__(self):  # noqa: PLE0307, RUF100 - it does not end
        while True:
            pass


def errors():
    """Returns exceptions whose texts do harm."""
    chained = ValueError("outer")
    chained.__cause__ = TextEndlessError()
    chained.__cause__.__context__ = chained
    return [
        TextRaisesError(),
        TextEndlessError(),
        ValueError("\ud800"),
        ValueError("x" * 30_000_000),
        KeyError(np.str_("key")),
        ValueError(np.float64(1), Text("text")),
        ValueError(Text("text")),
        ValueError(Raises()),
        ValueError(Endless()),
        ValueError(RING),
        chained,
    ]
