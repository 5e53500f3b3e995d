"""The judge notices what is wrong: each formula of an answer changed by a sign or a term."""

from __future__ import annotations

import copy

import pytest

from .judge import Judge
from .kinds.draw import parameters
from .motion import Motion
from .run import answer
from .system import CANONICAL, MAIN, System

BEAD = System(
    coordinates={"r": "positive", "phi": None},
    parameters=parameters("m", "k", "w"),
    T="m*(r'^2 + r^2*phi'^2)/2",
    V="k*r^2/2",
    constraints={"c1": "r = 2 + sin(phi)"},
    symmetries={"turn": {"phi": "1"}},
    sections=MAIN + CANONICAL,
)
PAIR = System(
    coordinates={"x": None, "y": None},
    parameters=parameters("m", "k"),
    T="m*(x'^2 + y'^2)/2",
    V="k*(x^2 + y^2 + (x - y)^2)/2",
    sections=("equilibria", "modes"),
    known={"search": True},
)
OF_BEAD = [
    ("lagrangian",),
    ("equations", 0, "equation"),
    ("matrix_form", "mass_matrix", 1, 1),
    ("matrix_form", "forcing", 0),
    ("matrix_form", "constraint_bias", 0),
    ("accelerations", "r"),
    ("multipliers", "c1", "value"),
    ("constraint_forces", "c1", "phi"),
    ("total_constraint_force", "phi"),
    ("momenta", "phi"),
    ("energy", "function"),
    ("hamiltonian",),
    ("canonical_equations", "r", "p"),
    ("canonical_equations", "phi", "q"),
    ("charges", 0, "rate"),
    ("charges", 0, "charge"),
    ("charges", 1, "charge"),
]
OF_PAIR = [("equilibria", 0, "at", "x"), ("modes", 0, "frequency"), ("modes", 1, "shape", "y")]


def changed(sheet, path, how):
    """The sheet with one formula changed."""
    sheet = copy.deepcopy(sheet)
    *way, last = path
    part = sheet
    for step in way:
        part = part[step]
    part[last] = how(part[last])
    return sheet


@pytest.mark.long
@pytest.mark.parametrize(
    ("system", "paths"), [(BEAD, OF_BEAD), (PAIR, OF_PAIR)], ids=["bead", "pair"]
)
def test_a_changed_formula_is_noticed(system, paths):
    sheet = answer(system)
    assert Judge(system, sheet).examine() == []
    for path in paths:
        scaled = () if path[0] == "charges" else ("-3*({}) - 1/7",)  # c Q + const is kept as well
        for how in ("({}) + t/3", "({})*t + 1/9", *scaled):
            wrong = changed(sheet, path, lambda text, how=how: _put(text, how))
            assert Judge(system, wrong).examine() != [], (path, how)


def _put(text, how):
    left, equals, right = text.partition("=")
    return f"{how.format(left)} {equals} {right}" if equals else how.format(text)


@pytest.mark.long
@pytest.mark.parametrize("kept", [True, False])
def test_a_turned_verdict_is_noticed(kept):
    sheet = answer(BEAD)
    [charge] = [each for each in sheet["charges"] if each["conserved"] is kept]
    charge["conserved"] = not kept
    assert [each.verdict for each in Judge(BEAD, sheet).examine()] != []


@pytest.mark.long
def test_a_place_of_rest_that_is_left_out_is_noticed():
    sheet = answer(PAIR)
    sheet["equilibria"] = []
    assert [each.section for each in Judge(PAIR, sheet).examine()] == ["equilibria"]
    sheet["equilibria"] = [{"at": {"x": "0", "y": "0"}, "stable": False}]
    assert [each.section for each in Judge(PAIR, sheet).examine()] == ["equilibria"]


@pytest.mark.parametrize("factor", ["1 + z*(U)", "1 + x*(U)", "2 + y*(U)^2"])
@pytest.mark.parametrize("surface", ["x*y - a^2", "x^2 + y^2 - a^2"])
def test_states_are_found_where_redundant_constraints_are_parallel(surface, factor):
    """u = 0 and u (1 + z u) = 0: Newton's step doubles z, since u z u = 0 has no gradient."""
    again = f"({surface})*({factor.replace('U', surface)})"
    made = System(
        coordinates={"x": None, "y": None, "z": None},
        parameters=parameters("m", "a"),
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="0",
        constraints={"c1": f"{surface} = 0", "c2": "z - a*x = 0", "c3": f"{again} = 0"},
    )
    for seed in range(3):
        motion = Motion(made, seed)
        state = motion.draw()
        assert state is not None
        assert all(abs(motion.value(name, state)) < 1e-30 for name in made.constraints)
