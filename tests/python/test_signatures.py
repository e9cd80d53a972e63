"""All that is public has a text, and inspect.signature says what the stub and the compiler say."""

import ast
import dataclasses
import inspect
import pathlib
import pydoc

import pytest

import hamjet

STUB = pathlib.Path(hamjet.__file__).with_name("_hamjet.pyi")
COMPILED = [hamjet.Jet, hamjet.GeneratingFunction, hamjet.Units]

#: Operators, whose meaning help() shows beside the named functions'.
OPERATORS = ("__call__", "__matmul__")


def public_parts():
    """(name, object) of everything in the package that a user may name."""
    for name in hamjet.__all__:
        value = getattr(hamjet, name)
        if name.startswith("__"):
            continue
        yield name, value
        if not inspect.isclass(value):
            continue
        for part, entry in vars(value).items():
            if not part.startswith("_") or part in OPERATORS:
                yield f"{name}.{part}", entry


def is_function(value):
    return callable(value) or isinstance(value, staticmethod)


def cases(condition):
    return [pytest.param(value, id=name) for name, value in public_parts() if condition(value)]


@pytest.mark.parametrize("function", cases(lambda v: is_function(v) and not inspect.isclass(v)))
def test_every_function_has_a_signature_and_a_text(function):
    function = getattr(function, "__func__", function)
    signature = inspect.signature(function)
    assert not any(parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
                   for parameter in signature.parameters.values())
    text = inspect.getdoc(function)
    assert text and "--\n" not in text and text.rstrip()[-1] in ".:])", text
    # What help() prints: the names of the arguments, and the text.
    shown = pydoc.render_doc(function, renderer=pydoc.plaintext)
    assert all(parameter in shown for parameter in signature.parameters)
    assert text.splitlines()[0] in shown and "(...)" not in shown


@pytest.mark.parametrize("value", cases(lambda v: inspect.isclass(v) or isinstance(v, property)))
def test_every_class_and_property_has_a_text(value):
    text = inspect.getdoc(value)
    assert text and "--\n" not in text
    # A data class without a text gets its signature as one.
    assert isinstance(value, property) or not text.startswith(f"{value.__name__}(")


def test_every_member_of_a_data_class_is_described_where_it_is_declared():
    classes = [v for _, v in public_parts() if inspect.isclass(v) and dataclasses.is_dataclass(v)]
    assert len(classes) >= 7
    for python_class in classes:
        lines = inspect.getsource(python_class).splitlines()
        for member in dataclasses.fields(python_class):
            if member.name.startswith("_") or member.name == "label":
                continue
            at = next(i for i, line in enumerate(lines)
                      if line.startswith(f"    {member.name}:"))
            assert "#: " in lines[at] or "#: " in lines[at - 1], (python_class, member.name)


def test_there_are_as_many_as_are_documented():
    assert len(cases(is_function)) >= 40


def stub_methods():
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        for method in getattr(node, "body", []):
            is_method = isinstance(method, ast.FunctionDef) and not any(
                getattr(decorator, "id", "") == "property" for decorator in method.decorator_list)
            if is_method and node.name in {python_class.__name__ for python_class in COMPILED}:
                yield node.name, method


def test_signatures_are_those_of_the_stub():
    checked = set()
    for owner, method in stub_methods():
        if method.name in ("__copy__", "__deepcopy__"):
            continue
        arguments = method.args
        empty = inspect.Parameter.empty
        plain = [empty] * (len(arguments.args) - len(arguments.defaults)) + [
            ast.literal_eval(default) for default in arguments.defaults]
        expected = [(a.arg, inspect.Parameter.POSITIONAL_OR_KEYWORD, default)
                    for a, default in zip(arguments.args, plain)]
        expected += [(a.arg, inspect.Parameter.KEYWORD_ONLY,
                      ast.literal_eval(default) if default else empty)
                     for a, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
        found = inspect.signature(getattr(getattr(hamjet, owner), method.name))
        assert [(p.name, p.kind, p.default) for p in found.parameters.values()] == expected
        checked.add(f"{owner}.{method.name}")
    assert {"Units.__init__", "Jet.from_arrays", "Jet.load", "Jet.save", "Jet.jacobian",
            "Jet.__matmul__", "GeneratingFunction.gradient"} <= checked and len(checked) == 17


def test_a_bound_method_has_no_self(jet):
    assert str(inspect.signature(jet.evaluate)) == "(deviations, *, out=None, degree=None)"
    # The names are those that the compiled part takes.
    bound = inspect.signature(jet.evaluate_relative).bind(states=[0.0] * 6, frame="inertial")
    assert jet.evaluate_relative(*bound.args, **bound.kwargs).states.shape == (1, 6)
