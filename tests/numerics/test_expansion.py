"""Formulas multiplied out: shorter, and the same numbers."""

from __future__ import annotations

from fractions import Fraction
from math import isclose

import pytest

import lagcli
from lagcli.graph.expansion import Expansion
from lagcli.graph.nodes import Constant, ancestry
from lagcli.graph.values import Concrete
from lagcli.mechanics.matrix_form import MatrixForm

LINK = "{coordinates: [a], points: {p: {position: [l*sin(a), -l*cos(a)], mass: m}}, V: -m*g*l*cos(a), parameters: [l, m, g]}"


def test_a_link_made_of_a_point_has_a_constant_inertia_and_no_forces_of_its_turning():
    form = MatrixForm(lagcli.loads(LINK).data, combine_angles=False)
    shorter = Expansion(form.graph)
    [a], [rate] = form.q, form.qdot
    assert form.mass_matrix[0][0].mask & a.mask
    assert not shorter(form.mass_matrix[0][0]).mask & a.mask
    assert not shorter(form.forcing[0]).mask & rate.mask
