"""A sentence says a word for each letter that the file has, and leaves the names of the file."""

import pytest

from lagcli.notation.letters import sentence


@pytest.mark.parametrize("taken", ["T", "V", "TV"])
def test_the_sum_of_both_energies_is_said_as_one(taken):
    said = sentence("it equals T + V", set(taken))
    assert said == "it equals the sum of the kinetic and the potential energy"
    assert sentence("it equals T + V", {"x"}) == "it equals T + V"


@pytest.mark.parametrize("name", ["L", "H", "T", "V"])
def test_a_function_of_the_file_keeps_its_name(name):
    for text in (
        f"the function {name} is not specified",
        f"no equilibrium is known (the functions U and {name} are not specified)",
    ):
        assert sentence(text, {name}) == text
    assert sentence(f"{name} is not known", {name}).split()[0] == "the"
