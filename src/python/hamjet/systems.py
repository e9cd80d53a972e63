"""Systems of one's own: a Hamiltonian or a vector field as a function, as text, or from SymPy."""

from __future__ import annotations

import dataclasses
import importlib
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _hamjet, shown
from .errors import UsageError
from .symbols import Symbol, Writer, free_prefix, number_text

#: The name of a system, for messages.
_NAME = "system"


def _names(names: Any, argument: str) -> tuple[str, ...]:
    if isinstance(names, str):
        names = names.replace(",", " ").split()
    if not isinstance(names, Sequence) or not all(isinstance(n, str) for n in names):
        raise UsageError(f"{argument}: wrong type, must be names as strings, or one string \"x y\"")
    return tuple(names)


def _momentum_of(coordinate: str) -> str:
    return "p" + coordinate[1:] if coordinate.startswith("q") else "p" + coordinate


@dataclasses.dataclass(frozen=True)
class System:
    """A system of one's own, as text: what `hamjet.system` makes. It can be pickled."""

    coordinates: tuple[str, ...] = ()  #: names; none of a vector field
    momenta: tuple[str, ...] = ()  #: names, in the order of the coordinates
    states: tuple[str, ...] = ()  #: names of the variables of a vector field
    #: Numbers, or expressions of numbers and parameters, by name.
    parameters: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    #: Expressions by name that others use.
    definitions: Mapping[str, str] = dataclasses.field(default_factory=dict)
    hamiltonian: str | None = None  #: an expression; None of a vector field
    #: Of each state, the expression of its derivative by the time; None of a Hamiltonian.
    vector_field: Mapping[str, str] | None = None

    def __repr__(self) -> str:
        kind, names = (("Hamiltonian of", (*self.coordinates, *self.momenta))
                       if self.hamiltonian is not None else ("vector field of", self.states))
        return shown.of(self, f": {kind} {shown.listed(names)}\n"
                        f" parameters: {shown.listed(self.parameters)}; "
                        f"{len(self.definitions)} definitions")

    def tables(self) -> dict[str, Any]:
        """The table `system` of a scene."""
        table: dict[str, Any] = {"model": "own"}
        if self.hamiltonian is not None:
            table.update(coordinates=list(self.coordinates), momenta=list(self.momenta),
                         hamiltonian=self.hamiltonian)
        else:
            table.update(states=list(self.states), vector_field=dict(self.vector_field or {}))
        if self.parameters:
            table["parameters"] = dict(self.parameters)
        if self.definitions:
            table["definitions"] = dict(self.definitions)
        return table

    def scene(self, start: Any, duration: float, *, order: int = 4,
              units: Mapping[str, float] | None = None,
              parameters: Mapping[str, Any] | None = None,
              variables: Sequence[str] | None = None,
              tables: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """A scene of this system, for `run`, `trajectory` and others.

        start: (q, p) or the states as numbers, or a dict of them by name, in which what is left out
        is 0. duration: in the system's own time. order: of the jet. units: what lengths and times of
        1 mean, {"length_km": ..., "time_s": ...}, and "mass_kg" if momenta and energies are to be
        told in kilograms; without it metres and seconds. parameters: other values of some.
        variables: names of those to expand in, parameters among them if you like, as in ["x", "px",
        "mu"]; by default coordinates and momenta, or the states. tables: further tables of the
        scene, such as {"generating_function": {"kinds": ["F1"]}}; entries of "jet" are added to its
        table. Results of a vector field have its adjoint variables, which are 0, behind the states.
        """
        system = self.tables()
        if parameters:
            known = dict(system.get("parameters", {}))
            for name, value in parameters.items():
                if name not in known:
                    raise UsageError(f"parameters: {name}: unknown, must be one of: "
                                     + ", ".join(known))
                known[name] = value
            system["parameters"] = known
        names = (*self.coordinates, *self.momenta) or self.states
        if isinstance(start, Mapping):
            for name in start:
                if name not in names:
                    raise UsageError(f"start: {name}: unknown, must be one of: " + ", ".join(names))
            values = [float(start.get(name, 0.0)) for name in names]
        else:
            values = [float(x) for x in np.asarray(start, dtype=float).ravel()]
        if len(values) != len(names):
            raise UsageError(f"start: {len(values)} numbers, must be {len(names)}: "
                             + ", ".join(names))
        n = len(self.coordinates)
        nominal = ({"coordinates": values[:n], "momenta": values[n:]}
                   if self.hamiltonian is not None else {"states": values})
        more = dict(tables or {})
        jet: dict[str, Any] = {"order": order, "duration_canonical": float(duration),
                               **more.pop("jet", {})}
        if variables is not None:
            jet["variables"] = list(_names(variables, "variables"))
        scene = {"schema": 1, "title": "A system of one's own", "system": system,
                 "nominal": nominal, "jet": jet, **more}
        if units is not None:
            scene["units"] = dict(units)
        return scene


def system(hamiltonian: Any = None, coordinates: Any = None, momenta: Any = None, *,
           parameters: Mapping[str, Any] | None = None,
           definitions: Mapping[str, str] | None = None,
           vector_field: Any = None, states: Any = None) -> System:
    """A system of your own.

        def h(q, p, mu):
            r1 = np.sqrt((q[0] + mu)**2 + q[1]**2)
            r2 = np.sqrt((q[0] - 1 + mu)**2 + q[1]**2)
            return p @ p/2 + q[1]*p[0] - q[0]*p[1] - (1 - mu)/r1 - mu/r2

        problem = hamjet.system(h, coordinates=["x", "y"], parameters={"mu": 0.0121505856})
        scene = problem.scene({"x": 0.8, "py": 0.9}, duration=2, order=4)
        jet = hamjet.run(scene).runs["gauss8"].jet

    hamiltonian: a function, an expression as text (data/scenes/expressions.md), or one of SymPy. A
    function gets symbols for the arguments that it names: coordinates, momenta and parameters by
    their names, or `q` and `p`, arrays of all of them, `z` both together, `t` the time.
    coordinates: names, or "x y". momenta: names; by default px of x, p of q, p1 of q1.
    parameters: numbers (or texts of constants) by name; they can be changed later.
    definitions: further expressions by name, for text.
    vector_field: in place of a Hamiltonian, the derivatives of the `states` by the time: a function
    that returns them in their order (its arguments are states, parameters, `x` all states, `t`), or
    a sequence or dict of texts or of SymPy's expressions.

    A function is traced: it runs once, on symbols that write down operators and NumPy's functions.
    Branches (`if`, comparisons, min, max), loops whose end depends on a symbol, and functions of
    `math` cannot be traced; each raises UsageError and says so. A number that the function computes
    on its own, from random numbers or the clock for example, becomes a constant.

    Raises SceneError, with part and column, if an expression is wrong.
    """
    given = dict(parameters or {})
    if (hamiltonian is None) == (vector_field is None):
        raise UsageError("system: must have either a hamiltonian or a vector_field")
    kept: dict[str, Any] = {name: value if isinstance(value, str) else _plain(value, name)
                            for name, value in given.items()}
    more = dict(definitions or {})
    if hamiltonian is not None:
        if coordinates is None:
            raise UsageError("coordinates: missing, must be names")
        q = _names(coordinates, "coordinates")
        p = (_names(momenta, "momenta") if momenta is not None
             else tuple(_momentum_of(name) for name in q))
        texts, found = _texts_of(hamiltonian, {"q": q, "p": p}, given, more, 1)
        made = System(coordinates=q, momenta=p, parameters=kept, definitions=found,
                      hamiltonian=texts[0])
    else:
        if states is None:
            raise UsageError("states: missing, must be names")
        x = _names(states, "states")
        if isinstance(vector_field, Mapping):
            missing = [name for name in x if name not in vector_field]
            if missing:
                raise UsageError(f"vector_field: nothing for {', '.join(missing)}")
            vector_field = [vector_field[name] for name in x]
        texts, found = _texts_of(vector_field, {"x": x}, given, more, len(x))
        made = System(states=x, parameters=kept, definitions=found,
                      vector_field=dict(zip(x, texts)))
    _hamjet.checked_system(made.tables(), _NAME)
    return made


def _plain(value: Any, name: str) -> float | int:
    text = number_text(value)
    return int(text) if isinstance(value, (int, np.integer)) else float(value) if text else 0


def _texts_of(given: Any, vectors: Mapping[str, tuple[str, ...]], parameters: Mapping[str, Any],
              definitions: dict[str, str], count: int) -> tuple[list[str], dict[str, str]]:
    """The expressions of a function or of a list of expressions, and their definitions."""
    names = [name for vector in vectors.values() for name in vector]
    if callable(given) and not hasattr(given, "free_symbols"):
        result = _traced(given, vectors, parameters)
    else:
        result = given
    outputs = list(result) if isinstance(result, (list, tuple, np.ndarray)) else [result]
    if len(outputs) != count:
        raise UsageError(f"system: {len(outputs)} expressions, must be {count}")
    outputs = [o.item() if isinstance(o, np.ndarray) and o.ndim == 0 else o for o in outputs]
    if any(hasattr(o, "free_symbols") for o in outputs):
        texts, found = _of_sympy(outputs, [*names, *parameters, *definitions])
        return texts, {**definitions, **found}
    if all(isinstance(o, str) for o in outputs):
        return [str(o) for o in outputs], definitions
    writer = Writer([*names, *parameters, *definitions])
    symbols = []
    for output in outputs:
        if not isinstance(output, Symbol):
            output = Symbol("number", (number_text(_as_number(output)),))
        symbols.append(output)
    texts = writer.write(symbols)
    return texts, {**definitions, **writer.definitions}


def _as_number(value: Any) -> Any:
    if value is None:
        raise UsageError("system: the function returned None, must return an expression")
    if not isinstance(value, (int, float, np.generic)):
        raise UsageError(f"system: wrong type, got {type(value).__name__}, must be an expression of "
                         "symbols, text or SymPy")
    return value


def _traced(function: Callable[..., Any], vectors: Mapping[str, tuple[str, ...]],
            parameters: Mapping[str, Any]) -> Any:
    symbols = {name: Symbol.named(name)
               for name in (*(n for v in vectors.values() for n in v), *parameters, "t")}
    known: dict[str, Any] = {}
    for vector, names in vectors.items():
        known[vector] = _array([symbols[name] for name in names])
    known["z"] = _array([symbols[n] for v in vectors.values() for n in v])
    known.update(symbols)  # a variable of the name q is itself
    arguments = []
    keywords = {}
    for name, parameter in inspect.signature(function).parameters.items():
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            continue
        if name not in known:
            if parameter.default is not parameter.empty:
                continue
            raise UsageError(f"system: the function has an argument {name}, must be one of: "
                             + ", ".join(known))
        if parameter.kind is parameter.KEYWORD_ONLY:
            keywords[name] = known[name]
        else:
            arguments.append(known[name])
    try:
        return function(*arguments, **keywords)
    except TypeError as error:
        if "'Symbol'" not in str(error) and "Symbol object" not in str(error):
            raise
        raise UsageError(
            f"system: one variable is used as a vector ({error}): an argument with the name of a "
            "variable is that variable, must be used as a number, or the vector have another name: "
            f"{', '.join(name for name in (*vectors, 'z') if name not in symbols)}") from None


def _array(symbols: list[Symbol]) -> Any:
    array = np.empty(len(symbols), dtype=object)
    for i, symbol in enumerate(symbols):
        array[i] = symbol
    return array


def _of_sympy(expressions: list[Any], names: list[str]) -> tuple[list[str], dict[str, str]]:
    """SymPy's expressions as text; common parts become definitions."""
    # SymPy is there, because its expressions are; its types differ between versions.
    sympy: Any = importlib.import_module("sympy")
    printers: Any = importlib.import_module("sympy.printing.str")

    class Printer(printers.StrPrinter):  # type: ignore[misc]
        def _print_Float(self, number: Any) -> str:
            return repr(float(number)) if number._prec <= 53 else str(number)

        def _print_Exp1(self, _: Any) -> str:
            return "exp(1)"

        def _print_ImaginaryUnit(self, _: Any) -> str:
            raise UsageError("expression: a complex number, got I, must be real")

    expressions = [sympy.sympify(e) for e in expressions]
    common, rest = sympy.cse(expressions, symbols=sympy.numbered_symbols(free_prefix(names), start=1))
    printer = Printer()
    return ([printer.doprint(e) for e in rest],
            {str(name): printer.doprint(e) for name, e in common})
