"""inspect.signature works on all that is public, and says what the stub and the compiler say."""

import ast
import inspect
import pathlib

import pytest

import hamjet

STUB = pathlib.Path(hamjet.__file__).with_name("_hamjet.pyi")
COMPILED = [hamjet.Jet, hamjet.GeneratingFunction, hamjet.Units]


def public_functions():
    for name in hamjet.__all__:
        value = getattr(hamjet, name)
        if inspect.isclass(value):
            for part, entry in vars(value).items():
                if callable(entry) and (not part.startswith("_") or part == "__call__"):
                    yield pytest.param(entry, id=f"{name}.{part}")
        elif callable(value):
            yield pytest.param(value, id=name)


@pytest.mark.parametrize("function", public_functions())
def test_every_function_has_a_signature_and_a_text(function):
    signature = inspect.signature(function)
    assert not any(parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
                   for parameter in signature.parameters.values())
    assert inspect.getdoc(function) and "--\n" not in inspect.getdoc(function)


def test_there_are_as_many_as_are_documented():
    assert len(list(public_functions())) >= 20


def stub_methods():
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        for method in getattr(node, "body", []):
            is_method = isinstance(method, ast.FunctionDef) and not method.decorator_list
            if is_method and node.name in {python_class.__name__ for python_class in COMPILED}:
                yield node.name, method


def test_signatures_are_those_of_the_stub():
    checked = 0
    for owner, method in stub_methods():
        if method.name in ("__copy__", "__deepcopy__"):
            continue
        arguments = method.args
        expected = [(a.arg, inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.empty)
                    for a in arguments.args]
        expected += [(a.arg, inspect.Parameter.KEYWORD_ONLY, ast.literal_eval(default))
                     for a, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
        found = inspect.signature(getattr(getattr(hamjet, owner), method.name))
        assert [(p.name, p.kind, p.default) for p in found.parameters.values()] == expected
        checked += 1
    assert checked == 11


def test_a_bound_method_has_no_self(jet):
    assert str(inspect.signature(jet.evaluate)) == "(deviations, *, out=None, degree=None)"
    # The names are those that the compiled part takes.
    bound = inspect.signature(jet.evaluate_relative).bind(states=[0.0] * 6, frame="inertial")
    assert jet.evaluate_relative(*bound.args, **bound.kwargs).states.shape == (1, 6)
