"""The scopes of a module: which names it binds and uses, and when each use runs.

The walk follows the order of execution, so that a name which is used above its definition is known too.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from translator.check.sources.found import Moment

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

Function = ast.FunctionDef | ast.AsyncFunctionDef
_EVERYTHING: Final = {"Exception", "BaseException"}
_COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_COMPOUND = (
    ast.If,
    ast.For,
    ast.AsyncFor,
    ast.While,
    ast.With,
    ast.AsyncWith,
    ast.Try,
    ast.TryStar,
    ast.Match,
)
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)
_LEAVES = (ast.Return, ast.Raise, ast.Break, ast.Continue, ast.Yield, ast.YieldFrom, ast.Await)


@dataclass(eq=False)
class Scope:
    """A module, class or function.

    Attributes:
        kind: `module`, `class`, `function` or `comprehension`.
        parent: the scope around it.
        names: the names that it binds.
        typing: names that it binds only where nothing runs.
        outside: names that it declares `global`.
    """

    kind: str
    parent: Scope | None = None
    names: set[str] = field(default_factory=set)
    typing: set[str] = field(default_factory=set)
    outside: set[str] = field(default_factory=set)

    @property
    def is_function(self) -> bool:
        """Whether the class scopes around it are not searched for its names."""
        return self.kind in {"function", "comprehension"}


@dataclass(frozen=True, slots=True)
class Use:
    """A name that is read.

    Attributes:
        is_bound: whether a statement above binds it; only known while a module is loaded.
        attributes: the attributes that are read of it: `common`, `Status` for ``py_trees.common.Status``.
    """

    name: str
    node: ast.AST
    scope: Scope
    moment: Moment
    is_bound: bool
    attributes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Binding:
    """Where a name of the module is bound; `statement` is None if by no import."""

    line: int
    statement: ast.Import | ast.ImportFrom | None


@dataclass(frozen=True, slots=True)
class Imported:
    """A statement `import`.

    Attributes:
        is_tried: whether it may fail, because a `try` is around it.
        is_inner: whether it is in a function.
    """

    node: ast.Import | ast.ImportFrom
    moment: Moment
    is_tried: bool
    is_inner: bool


@dataclass(slots=True)
class _State:
    """Where the walk is: the scope, the moment, and the exceptions that would be caught."""

    scope: Scope
    moment: Moment
    catches: frozenset[str] = frozenset()
    is_tried: bool = False

    def but(self, **changes: object) -> _State:
        values = {"scope": self.scope, "moment": self.moment, "catches": self.catches}
        return _State(**{**values, "is_tried": self.is_tried, **changes})  # type: ignore[arg-type]

    def later(self) -> _State:
        return self if self.moment is Moment.NEVER else self.but(moment=Moment.LATER)


class Scopes:
    """The scopes of one module.

    Args:
        module: its syntax tree.
        made: the methods that surely run when a node is made.
    """

    def __init__(self, module: ast.Module, made: Collection[Function] = ()) -> None:
        self.module = Scope("module")
        self.uses: list[Use] = []
        self.imports: list[Imported] = []
        self.bindings: dict[str, list[Binding]] = {}
        self.has_star = False
        self._made = made
        self._annotates_lazily = any(
            isinstance(node, ast.ImportFrom)
            and node.module == "__future__"
            and any(alias.name == "annotations" for alias in node.names)
            for node in module.body
        )
        self._body(module.body, _State(self.module, Moment.LOAD))
        self._made = ()  # what is kept of a source holds no part of its tree

    def knows(self, use: Use) -> bool:
        """Returns whether a name is bound somewhere where the use finds it; builtins are not asked."""
        return self._owner(use) is not None

    def is_global(self, use: Use) -> bool:
        """Returns whether a name is one of the module."""
        return self._owner(use) is self.module

    def is_early(self, use: Use) -> bool:
        """Returns whether code surely reads a name before anything has bound it."""
        owner = self._owner(use)
        if owner is None or use.is_bound or use.moment not in {Moment.LOAD, Moment.MAKE}:
            return False
        return owner is use.scope or (owner is self.module and use.moment is Moment.LOAD)

    def _owner(self, use: Use) -> Scope | None:
        scope: Scope | None = use.scope
        is_own = True
        while scope is not None:
            if use.name in scope.outside:
                scope = self.module
            visible = is_own or scope.kind != "class"
            if visible and use.name in scope.names:
                return scope
            is_own = False
            scope = scope.parent
        return None

    def _body(self, statements: Iterable[ast.stmt], state: _State) -> None:
        for statement in statements:
            self._statement(statement, state)
            if isinstance(statement, ast.Return | ast.Raise | ast.Break | ast.Continue):
                state = state.but(moment=Moment.NEVER)
            elif isinstance(statement, _COMPOUND) and _can_leave(statement):
                state = state.later()

    def _statement(self, node: ast.stmt, state: _State) -> None:  # noqa: C901, PLR0912 - one case a kind
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            self._function(node, state)
        elif isinstance(node, ast.ClassDef):
            self._class(node, state)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            self._import(node, state)
        elif isinstance(node, ast.Global | ast.Nonlocal):
            if isinstance(node, ast.Global):
                state.scope.outside.update(node.names)
        elif isinstance(node, ast.AnnAssign):
            if node.value is not None:
                self._expression(node.value, state)
            if not state.scope.is_function:
                self._annotation(node.annotation, state)
            if node.value is not None or not isinstance(node.target, ast.Name):
                self._expression(node.target, state)
        elif isinstance(node, ast.Assign):
            self._expression(node.value, state)
            for target in node.targets:
                self._expression(target, state)
        elif isinstance(node, ast.AugAssign):
            if isinstance(node.target, ast.Name):
                self._use(node.target, state)
            self._expression(node.value, state)
            self._expression(node.target, state)
        elif isinstance(node, ast.If):
            self._if(node, state)
        elif isinstance(node, ast.While):
            self._expression(node.test, state)
            self._body(node.body, state.later())
            self._body(node.orelse, state.later())
        elif isinstance(node, ast.For | ast.AsyncFor):
            self._expression(node.iter, state)
            self._expression(node.target, state)
            self._body(node.body, state.later())
            self._body(node.orelse, state.later())
        elif isinstance(node, ast.With | ast.AsyncWith):
            self._with(node, state)
        elif isinstance(node, ast.Try | ast.TryStar):
            self._try(node, state)
        elif isinstance(node, ast.Match):
            self._expression(node.subject, state)
            for case in node.cases:
                self._pattern(case.pattern, state.later())
                if case.guard is not None:
                    self._expression(case.guard, state.later())
                self._body(case.body, state.later())
        else:
            self._parts(node, state)

    def _if(self, node: ast.If, state: _State) -> None:
        self._expression(node.test, state)
        truth = _truth(node.test)
        never = state.but(moment=Moment.NEVER)
        body = {True: state, False: never, None: state.later()}[truth]
        other = {True: never, False: state, None: state.later()}[truth]
        self._body(node.body, body)
        self._body(node.orelse, other)

    def _with(self, node: ast.With | ast.AsyncWith, state: _State) -> None:
        inner = state
        for item in node.items:
            self._expression(item.context_expr, state)
            if item.optional_vars is not None:
                self._expression(item.optional_vars, state)
            call = item.context_expr
            if isinstance(call, ast.Call) and _last(call.func) == "suppress":
                inner = inner.but(catches=inner.catches | _caught(call.args), is_tried=True)
        self._body(node.body, inner.later())  # the context may end an exception

    def _try(self, node: ast.Try | ast.TryStar, state: _State) -> None:
        inner = state.but(is_tried=True)
        caught = {
            name
            for handler in node.handlers
            for name in (_EVERYTHING if handler.type is None else _caught([handler.type]))
        }
        self._body(node.body, inner.but(catches=state.catches | caught))
        for handler in node.handlers:
            if handler.type is not None:
                self._expression(handler.type, inner.later())
            if handler.name is not None:
                self._bind(handler.name, handler, state)
            self._body(handler.body, inner.later())
        self._body(node.orelse, inner.later())
        self._body(node.finalbody, state)

    def _function(self, node: Function, state: _State) -> None:
        for decorator in node.decorator_list:
            self._expression(decorator, state)
        arguments = node.args
        self._defaults(arguments, state)
        for argument in _all_arguments(arguments):
            if argument.annotation is not None:
                self._annotation(argument.annotation, state)
        if node.returns is not None:
            self._annotation(node.returns, state)
        self._bind(node.name, node, state)
        inner = Scope("function", state.scope, {argument.arg for argument in _all_arguments(arguments)})
        if state.scope.kind == "class":
            inner.names.add("__class__")
        moment = Moment.MAKE if node in self._made else Moment.LATER
        if state.moment is Moment.NEVER:
            moment = Moment.NEVER
        self._body(node.body, _State(inner, moment))

    def _class(self, node: ast.ClassDef, state: _State) -> None:
        for part in (*node.decorator_list, *node.bases, *(keyword.value for keyword in node.keywords)):
            self._expression(part, state)
        inner = Scope("class", state.scope, {"__module__", "__qualname__"})
        self._body(node.body, state.but(scope=inner))
        self._bind(node.name, node, state)

    def _import(self, node: ast.Import | ast.ImportFrom, state: _State) -> None:
        scope: Scope | None = state.scope
        while scope is not None and not scope.is_function:
            scope = scope.parent
        tried = state.is_tried or bool(state.catches)
        self.imports.append(Imported(node, state.moment, tried, scope is not None))
        for alias in node.names:
            if alias.name == "*":
                self.has_star = True
            else:
                self._bind(alias.asname or alias.name.partition(".")[0], node, state)

    def _bind(self, name: str, node: ast.AST, state: _State) -> None:
        scope = state.scope
        while scope.kind == "comprehension" and scope.parent is not None:
            scope = scope.parent  # an assignment expression
        if name in scope.outside:
            scope = self.module
        is_typing = state.moment is Moment.NEVER and not scope.is_function
        (scope.typing if is_typing else scope.names).add(name)
        if scope is self.module:
            self._note(name, node)

    def _note(self, name: str, node: ast.AST) -> None:
        statement = node if isinstance(node, ast.Import | ast.ImportFrom) else None
        self.bindings.setdefault(name, []).append(Binding(getattr(node, "lineno", 1), statement))

    def _annotation(self, node: ast.expr, state: _State) -> None:
        if not self._annotates_lazily:
            self._expression(node, state)

    def _defaults(self, arguments: ast.arguments, state: _State) -> None:
        for default in (*arguments.defaults, *arguments.kw_defaults):
            if default is not None:
                self._expression(default, state)

    def _parts(self, node: ast.AST, state: _State) -> None:
        for part in ast.iter_child_nodes(node):
            if isinstance(part, ast.expr):
                self._expression(part, state)
            elif not isinstance(part, ast.expr_context):
                self._parts(part, state)

    def _expression(self, node: ast.expr, state: _State) -> None:
        if isinstance(node, ast.Name):
            if isinstance(node.ctx, ast.Load):
                self._use(node, state)
            elif isinstance(node.ctx, ast.Store):
                self._bind(node.id, node, state)
        elif isinstance(node, ast.Attribute):
            self._attribute(node, state)
        elif isinstance(node, ast.BoolOp):
            self._first_then(node.values, 1, state)
        elif isinstance(node, ast.Compare):
            self._first_then([node.left, *node.comparators], 2, state)
        elif isinstance(node, ast.IfExp):
            self._first_then([node.test, node.body, node.orelse], 1, state)
        elif isinstance(node, ast.NamedExpr):
            self._expression(node.value, state)
            self._bind(node.target.id, node, state)
        elif isinstance(node, ast.Lambda):
            self._defaults(node.args, state)
            names = {argument.arg for argument in _all_arguments(node.args)}
            self._expression(node.body, state.later().but(scope=Scope("function", state.scope, names)))
        elif isinstance(node, _COMPREHENSIONS):
            self._comprehension(node, state)
        else:
            self._parts(node, state)

    def _first_then(self, values: Sequence[ast.expr], sure: int, state: _State) -> None:
        """Visits expressions of which only the first ones are surely evaluated."""
        for index, value in enumerate(values):
            self._expression(value, state if index < sure else state.later())

    def _comprehension(
        self, node: ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp, state: _State
    ) -> None:
        inner = state.later().but(scope=Scope("comprehension", state.scope))
        for index, generator in enumerate(node.generators):
            self._expression(generator.iter, state if index == 0 else inner)
            for name in ast.walk(generator.target):
                if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store):
                    inner.scope.names.add(name.id)
            for condition in generator.ifs:
                self._expression(condition, inner)
        parts = [node.key, node.value] if isinstance(node, ast.DictComp) else [node.elt]
        for part in parts:
            self._expression(part, inner)

    def _attribute(self, node: ast.Attribute, state: _State) -> None:
        names: list[str] = []
        inner: ast.expr = node
        while isinstance(inner, ast.Attribute):
            names.append(inner.attr)
            inner = inner.value
        if not isinstance(inner, ast.Name):
            self._expression(inner, state)
            return
        if not isinstance(node.ctx, ast.Load):
            self._note(inner.id, node)  # what has the name is changed
            names.clear()
        known = {"AttributeError", *_EVERYTHING}.isdisjoint(state.catches)
        self._use(inner, state, tuple(reversed(names)) if known else (), node)

    def _use(
        self, name: ast.Name, state: _State, attributes: tuple[str, ...] = (), node: ast.AST | None = None
    ) -> None:
        if state.moment is Moment.NEVER or not {"NameError", *_EVERYTHING}.isdisjoint(state.catches):
            return
        above = state.scope.names | (set() if state.scope.is_function else self.module.names)
        is_bound = name.id in above
        self.uses.append(Use(name.id, node or name, state.scope, state.moment, is_bound, attributes))

    def _pattern(self, pattern: ast.pattern, state: _State) -> None:
        for part in ast.walk(pattern):
            name = getattr(part, "name", None) or getattr(part, "rest", None)
            if isinstance(part, ast.MatchAs | ast.MatchStar | ast.MatchMapping) and name:
                self._bind(name, part, state)
            elif isinstance(part, ast.MatchValue):
                self._expression(part.value, state)
            elif isinstance(part, ast.MatchClass):
                self._expression(part.cls, state)


def _all_arguments(arguments: ast.arguments) -> list[ast.arg]:
    more = [each for each in (arguments.vararg, arguments.kwarg) if each is not None]
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *more]


def _last(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def _caught(types: Iterable[ast.expr]) -> frozenset[str]:
    found = [each.elts if isinstance(each, ast.Tuple) else [each] for each in types]
    return frozenset(_last(each) or "Exception" for group in found for each in group)


def _truth(test: ast.expr) -> bool | None:
    """Returns what a condition is in a module that an action's class is loaded from; None if unknown."""
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        inner = _truth(test.operand)
        return None if inner is None else not inner
    if isinstance(test, ast.Constant):
        return bool(test.value)
    if _last(test) == "TYPE_CHECKING":
        return False
    if isinstance(test, ast.Compare) and _last(test.left) == "__name__" and len(test.ops) == 1:
        other = test.comparators[0]
        is_main = isinstance(other, ast.Constant) and other.value == "__main__"
        return isinstance(test.ops[0], ast.NotEq) if is_main else None
    return None


def _can_leave(statement: ast.stmt) -> bool:
    """Returns whether what follows a statement may not run because of it."""
    stack: list[ast.AST] = list(ast.iter_child_nodes(statement))
    while stack:
        node = stack.pop()
        if isinstance(node, _LEAVES):
            return True
        if not isinstance(node, _SCOPES):
            stack.extend(ast.iter_child_nodes(node))
    return False
