"""Records behave as frozen dataclasses with slots do."""

import copy
import dataclasses
import pickle

import pytest

from lagcli.diagnostics import NOWHERE, Span
from lagcli.expression import Name, Number, Product, Sum
from lagcli.problem_data import Expect, Parameter
from lagcli.record import replace

HERE = Span(1, 2, 1, 5)


def test_fields_are_given_by_place_or_by_name():
    assert Name("x", 2) == Name(name="x", primes=2)
    assert Name("x").primes == 0
    assert Parameter(name="m", integer=True).assume == "real"


@pytest.mark.parametrize(
    ("given", "named"),
    [((), {}), (("x", 1, HERE), {}), (("x",), {"name": "y"}), (("x",), {"colour": "red"})],
)
def test_wrong_arguments_are_refused(given, named):
    with pytest.raises(TypeError, match="Name"):
        Name(*given, **named)


def test_fields_by_name_only_have_no_place():
    with pytest.raises(TypeError, match="Parameter"):
        Parameter("m")


def test_the_place_in_the_file_takes_no_part_in_equality_and_hash():
    assert Name("x", span=HERE) == Name("x")
    assert hash(Name("x", span=HERE)) == hash(Name("x"))
    assert repr(Name("x", span=HERE)) == "Name(name='x', primes=0)"


def test_records_of_two_classes_are_never_equal():
    terms = (Name("x"), Name("y"))
    assert Sum(terms) != Product(terms)


def test_records_are_frozen_and_have_no_other_attributes():
    x = Name("x")
    with pytest.raises(dataclasses.FrozenInstanceError):
        x.name = "y"
    with pytest.raises(dataclasses.FrozenInstanceError):
        del x.name
    assert not hasattr(x, "__dict__")


def test_patterns_match_by_place_and_by_name():
    match Sum((Name("x"),)):
        case Sum(terms=(Name(name),)):
            assert name == "x"
        case _:
            pytest.fail("no match")


def test_copies_and_pickles_are_equal_and_keep_what_equality_ignores():
    tree = Sum((Name("x", 1, span=HERE), Name("y")), span=HERE)
    for made in (copy.copy(tree), copy.deepcopy(tree), pickle.loads(pickle.dumps(tree))):
        assert made == tree
        assert made.span == HERE


def test_dataclasses_know_records():
    x = Name("x", span=HERE)
    assert dataclasses.is_dataclass(x)
    assert {part.name for part in dataclasses.fields(x)} == {"name", "primes", "span"}
    for changed in (dataclasses.replace(x, primes=1), replace(x, primes=1)):
        assert changed == Name("x", 1)
        assert changed.span == HERE
    assert {part.name for part in dataclasses.fields(Number)} == {"value", "decimal", "span"}


def test_defaults_that_are_made_are_made_for_each():
    assert Expect().momenta == {}
    assert Expect().momenta is not Expect().momenta


def test_spans_are_ordered():
    assert NOWHERE < HERE < Span(1, 3, 1, 4)
    assert sorted([HERE, NOWHERE]) == [NOWHERE, HERE]
    assert max(NOWHERE, HERE) == HERE
