"""Numbers that write down what is done to them: an ordinary function run on them becomes text."""

from __future__ import annotations

import numbers
from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any

import numpy as np

from .errors import UsageError

#: What a branch on a symbol raises.
_BRANCH = ("a branch depends on {0}: a function that is traced runs once, on symbols, so that `if`, "
           "`while`, `and`, `or`, min, max and comparisons of them cannot choose; must be one smooth "
           "expression (a branch on parameters alone can be made before, by plain numbers)")
_SMOOTH = "{0} has no Taylor series where it {1}, must be a smooth function, such as {2}"

#: How closely a text binds: what stands beside an operator may need parentheses.
_SUM, _PRODUCT, _POWER, _WHOLE = range(4)

#: Texts are made by recursion of this depth at most; what is nested deeper gets a name.
_DEEPEST = 40


def number_text(value: Any) -> str:
    """A number as text that brings it back: the shortest decimal of a float, an exact fraction."""
    if isinstance(value, bool) or isinstance(value, np.bool_):
        raise UsageError("expression: a truth value, must be a number")
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, Fraction):
        return f"({value.numerator}/{value.denominator})"
    if isinstance(value, numbers.Complex) and not isinstance(value, numbers.Real):
        raise UsageError(f"expression: a complex number, got {value}, must be real")
    number = float(value)
    if number != number or number in (float("inf"), float("-inf")):
        raise UsageError(f"expression: no finite number, got {number}, must be finite")
    return repr(number)


class Symbol:
    """A variable, or what was computed from variables. Operators, powers, and NumPy's functions
    give further symbols; what needs a number, such as math.sin, float(), or a branch, raises."""

    __slots__ = ("_kind", "_operands", "_depth")
    __array_priority__ = 1000

    _kind: str
    _operands: tuple[Any, ...]
    _depth: int

    def __init__(self, kind: str, operands: tuple[Any, ...]) -> None:
        self._kind = kind
        self._operands = operands
        self._depth = 1 + max((o._depth for o in operands if isinstance(o, Symbol)), default=0)

    @classmethod
    def named(cls, name: str) -> Symbol:
        return cls("name", (name,))

    def __repr__(self) -> str:
        return f"<hamjet symbol {self._operands[0]}>" if self._kind == "name" else "<hamjet symbol>"

    # Arithmetic.

    def __add__(self, other: Any) -> Any: return _binary("+", self, other)
    def __radd__(self, other: Any) -> Any: return _binary("+", other, self)
    def __sub__(self, other: Any) -> Any: return _binary("-", self, other)
    def __rsub__(self, other: Any) -> Any: return _binary("-", other, self)
    def __mul__(self, other: Any) -> Any: return _binary("*", self, other)
    def __rmul__(self, other: Any) -> Any: return _binary("*", other, self)
    def __truediv__(self, other: Any) -> Any: return _binary("/", self, other)
    def __rtruediv__(self, other: Any) -> Any: return _binary("/", other, self)
    def __pow__(self, other: Any) -> Any: return _binary("^", self, other)
    def __rpow__(self, other: Any) -> Any: return _binary("^", other, self)
    def __neg__(self) -> Symbol: return Symbol("neg", (self,))
    def __pos__(self) -> Symbol: return self

    # What cannot be traced.

    def _branch(self, *_: Any) -> Any:
        raise UsageError(_BRANCH.format("a symbol"))

    __bool__ = __lt__ = __le__ = __gt__ = __ge__ = _branch
    __eq__ = __ne__ = _branch
    __hash__ = object.__hash__

    def __abs__(self) -> Any:
        raise UsageError(_SMOOTH.format("abs", "has its corner", "sqrt(x**2 + y**2)"))

    def _jump(self, *_: Any) -> Any:
        raise UsageError(_SMOOTH.format("rounding or a remainder", "jumps", "(1 + tanh(x/d))/2"))

    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __floor__ = __ceil__ = __round__ = _jump
    __trunc__ = _jump

    def _number(self) -> Any:
        raise UsageError("a symbol has no value yet: float(), int() and the functions of math need "
                         "numbers, must be NumPy's functions, such as numpy.sin")

    __float__ = __int__ = __index__ = __complex__ = _number

    # NumPy: its functions on a symbol, and, by the methods of these names, on arrays of symbols.

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        keywords.pop("dtype", None)
        if any(isinstance(x, np.ndarray) and x.ndim > 0 for x in inputs) and method == "__call__":
            arrays = [_as_object(x) for x in inputs]
            return getattr(ufunc, method)(*arrays, **keywords)
        if method != "__call__" or keywords:
            raise UsageError(f"numpy.{ufunc.__name__}: not this form of it on symbols, must be a "
                             "plain call")
        return call(ufunc.__name__, inputs)

    def sqrt(self) -> Symbol: return call("sqrt", (self,))
    def exp(self) -> Symbol: return call("exp", (self,))
    def log(self) -> Symbol: return call("log", (self,))
    def sin(self) -> Symbol: return call("sin", (self,))
    def cos(self) -> Symbol: return call("cos", (self,))
    def tan(self) -> Symbol: return call("tan", (self,))
    def arcsin(self) -> Symbol: return call("arcsin", (self,))
    def arccos(self) -> Symbol: return call("arccos", (self,))
    def arctan(self) -> Symbol: return call("arctan", (self,))
    def arctan2(self, x: Any) -> Symbol: return call("arctan2", (self, x))
    def sinh(self) -> Symbol: return call("sinh", (self,))
    def cosh(self) -> Symbol: return call("cosh", (self,))
    def tanh(self) -> Symbol: return call("tanh", (self,))
    def square(self) -> Symbol: return call("square", (self,))
    def conjugate(self) -> Symbol: return self


def _as_object(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.astype(object)
    array = np.empty((), dtype=object)
    array[()] = value
    return array


#: NumPy's functions by the names that expressions have for them.
_FUNCTIONS = {name: name for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh",
                                      "tanh")}
_FUNCTIONS.update(arcsin="asin", arccos="acos", arctan="atan", arctan2="atan2")

_MADE_OF_OTHERS: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: _binary("+", a, b),
    "subtract": lambda a, b: _binary("-", a, b),
    "multiply": lambda a, b: _binary("*", a, b),
    "divide": lambda a, b: _binary("/", a, b),
    "true_divide": lambda a, b: _binary("/", a, b),
    "power": lambda a, b: _binary("^", a, b),
    "float_power": lambda a, b: _binary("^", a, b),
    "negative": lambda a: -a,
    "positive": lambda a: a,
    "conjugate": lambda a: a,
    "square": lambda a: a ** 2,
    "reciprocal": lambda a: 1 / a,
    "hypot": lambda a, b: call("sqrt", (a ** 2 + b ** 2,)),
    "exp2": lambda a: _binary("^", 2, a),
    "log2": lambda a: call("log", (a,)) / call("log", (Symbol("number", ("2",)),)),
    "log10": lambda a: call("log", (a,)) / call("log", (Symbol("number", ("10",)),)),
    "deg2rad": lambda a: a * Symbol.named("pi") / 180,
    "radians": lambda a: a * Symbol.named("pi") / 180,
    "rad2deg": lambda a: a * 180 / Symbol.named("pi"),
    "degrees": lambda a: a * 180 / Symbol.named("pi"),
    "arcsinh": lambda a: call("log", (a + call("sqrt", (a ** 2 + 1,)),)),
    "arccosh": lambda a: call("log", (a + call("sqrt", (a ** 2 - 1,)),)),
    "arctanh": lambda a: call("log", ((1 + a) / (1 - a),)) / 2,
}


def call(name: str, arguments: Iterable[Any]) -> Symbol:
    """A function of NumPy on symbols, or on symbols and numbers."""
    if name in _FUNCTIONS:
        return Symbol(_FUNCTIONS[name], tuple(_operand(a) for a in arguments))
    if name in _MADE_OF_OTHERS:
        made: Symbol = _MADE_OF_OTHERS[name](*arguments)
        return made
    if name in ("less", "less_equal", "greater", "greater_equal", "equal", "not_equal", "maximum",
                "minimum", "fmax", "fmin", "logical_and", "logical_or", "logical_not", "isfinite"):
        raise UsageError(_BRANCH.format(f"numpy.{name} of a symbol"))
    if name in ("absolute", "fabs", "sign", "floor", "ceil", "rint", "trunc", "remainder", "fmod",
                "mod", "heaviside", "floor_divide"):
        raise UsageError(_SMOOTH.format(f"numpy.{name}", "has a corner or jumps",
                                        "sqrt(x**2 + d**2), or (1 + tanh(x/d))/2"))
    raise UsageError(f"numpy.{name}: not a function of expressions, must be one of: "
                     + ", ".join([*_FUNCTIONS, *_MADE_OF_OTHERS]))


def _operand(value: Any) -> Symbol:
    if isinstance(value, Symbol):
        return value
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return _operand(value.item())
    if not isinstance(value, (numbers.Number, np.generic)):
        raise UsageError(f"expression: wrong type, got {type(value).__name__}, must be a number or a "
                         "symbol")
    return Symbol("number", (number_text(value),))


def _binary(operator: str, a: Any, b: Any) -> Any:
    for value in (a, b):
        if isinstance(value, np.ndarray) and value.ndim > 0 or isinstance(value, (list, tuple)):
            return NotImplemented
    return Symbol(operator, (_operand(a), _operand(b)))


def free_prefix(names: Iterable[str]) -> str:
    """A prefix with which none of the names begins, for names of definitions."""
    taken = list(names)
    prefix = "w"
    while any(name.startswith(prefix) for name in taken):
        prefix += "_"
    return prefix


class Writer:
    """Writes symbols as expressions; what is used more than once becomes a definition."""

    def __init__(self, names: Iterable[str]) -> None:
        self.definitions: dict[str, str] = {}
        self._texts: dict[int, tuple[str, int]] = {}
        self._kept: list[Symbol] = []
        self._uses: dict[int, int] = {}
        self._prefix = free_prefix(names)

    def write(self, symbols: list[Symbol]) -> list[str]:
        order: list[Symbol] = []
        for symbol in symbols:
            self._visit(symbol, order)
        for symbol in order:
            self._texts[id(symbol)] = self._text(symbol)
        return [self._texts[id(symbol)][0] for symbol in symbols]

    def _visit(self, root: Symbol, order: list[Symbol]) -> None:
        """Puts the operands of a symbol into the order, each before what it is used in."""
        stack: list[tuple[Symbol, bool]] = [(root, False)]
        while stack:
            symbol, is_done = stack.pop()
            if is_done:
                order.append(symbol)
                continue
            self._uses[id(symbol)] = self._uses.get(id(symbol), 0) + 1
            if self._uses[id(symbol)] > 1:
                continue
            self._kept.append(symbol)
            stack.append((symbol, True))
            stack.extend((o, False) for o in reversed(symbol._operands) if isinstance(o, Symbol))

    def _text(self, symbol: Symbol) -> tuple[str, int]:
        kind, operands = symbol._kind, symbol._operands
        if kind in ("name", "number"):
            text = operands[0]
            return text, _SUM if text.startswith("-") else _WHOLE
        texts = [self._texts[id(o)] for o in operands]
        if kind == "neg":
            written = "-" + _within(texts[0], _PRODUCT), _SUM
        elif kind in "+-":
            written = (f"{_within(texts[0], _SUM)} {kind} "
                       f"{_within(texts[1], _SUM if kind == '+' else _PRODUCT)}"), _SUM
            if kind == "+" and texts[1][0].startswith("-"):
                written = f"{texts[0][0]} + ({texts[1][0]})", _SUM
        elif kind in "*/":
            written = f"{_within(texts[0], _PRODUCT)}{kind}{_within(texts[1], _POWER)}", _PRODUCT
        elif kind == "^":
            written = f"{_within(texts[0], _WHOLE)}^{_within(texts[1], _WHOLE)}", _POWER
        else:
            written = f"{kind}({', '.join(text for text, _ in texts)})", _WHOLE
        is_deep = symbol._depth % _DEEPEST == 0
        if self._uses[id(symbol)] > 1 or is_deep:
            name = f"{self._prefix}{len(self.definitions) + 1}"
            self.definitions[name] = written[0]
            return name, _WHOLE
        return written


def _within(text: tuple[str, int], binding: int) -> str:
    return text[0] if text[1] >= binding else f"({text[0]})"
