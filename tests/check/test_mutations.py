"""The check is able to fail: every slip in an expectation is caught, and where it stands."""

from __future__ import annotations

import pytest

from lagcli.studies.check import CheckOutcome
from lagcli.studies.check.one import check_problem

HOOP = """\
coordinates: [x, theta]
parameters:
  M: {assume: positive}
  R: {assume: positive}
  alpha:
  g: {assume: positive}
T: M*x'^2/2 + M*R^2*theta'^2/2
V: -M*g*x*sin(alpha)
constraints:
  rolling: x - R*theta
symmetries:
  slide: {x: R, theta: 1}
expect:
  degrees_of_freedom: 1
  equations:
    - "2*x'' = g*sin(alpha)"
    - "M*x'' - M*g*sin(alpha) = lambda_rolling"
  accelerations: {x: g*sin(alpha)/2, theta: g*sin(alpha)/(2*R)}
  multipliers: {rolling: -M*g*sin(alpha)/2}
  constraint_forces: {rolling: {x: -M*g*sin(alpha)/2, theta: M*R*g*sin(alpha)/2}}
  momenta: {x: M*x', theta: M*R^2*theta'}
  hamiltonian: p_x^2/(2*M) + p_theta^2/(2*M*R^2) - M*g*x*sin(alpha)
  energy: M*x'^2/2 + M*R^2*theta'^2/2 - M*g*x*sin(alpha)
  charges:
    slide: M*R*x' + M*R^2*theta' - M*R*g*t*sin(alpha)
    energy: M*x'^2 - M*g*x*sin(alpha)
    p_theta: not conserved
"""

#: Part of the file, what it is changed to, and the answer that is then wrong.
SLIPS = [
    ("degrees_of_freedom: 1", "degrees_of_freedom: 2", "degrees_of_freedom"),
    ("2*x'' = g", "2*x'' = -g", "equations.0"),
    ("2*x'' = g", "3*x'' = g", "equations.0"),
    ("M*g*sin(alpha) = lambda_rolling", "M*g*sin(alpha) = -lambda_rolling", "equations.1"),
    ("M*x'' - M*g*sin(alpha) =", "M*x'' =", "equations.1"),
    ("{x: g*sin(alpha)/2,", "{x: g*sin(alpha),", "accelerations.x"),
    ("theta: g*sin(alpha)/(2*R)}", "theta: g*cos(alpha)/(2*R)}", "accelerations.theta"),
    ("{rolling: -M*g*sin(alpha)/2}", "{rolling: M*g*sin(alpha)/2}", "multipliers.rolling"),
    ("theta: M*R*g*sin", "theta: -M*R*g*sin", "constraint_forces.rolling.theta"),
    ("theta: M*R^2*theta'}", "theta: M*R*theta'}", "momenta.theta"),
    ("hamiltonian: p_x^2/(2*M)", "hamiltonian: p_x^2/M", "hamiltonian"),
    (" - M*g*x*sin(alpha)\n  energy", "\n  energy", "hamiltonian"),
    ("energy: M*x'^2/2 +", "energy: -M*x'^2/2 +", "energy"),
    ("slide: M*R*x' + M*R^2*theta'", "slide: M*R*x' - M*R^2*theta'", "charges.slide"),
    (" - M*R*g*t*sin(alpha)", "", "charges.slide"),
    ("M*R*g*t", "2*M*R*g*t", "charges.slide"),
    ("slide: M*R*x' + M*R^2*theta' - M*R*g*t*sin(alpha)", "slide: not conserved", "charges.slide"),
    ("energy: M*x'^2 -", "energy: M*x'^2/3 -", "charges.energy"),
    ("p_theta: not conserved", "p_theta: M*R^2*theta'", "charges.p_theta"),
]

#: The same answers written otherwise.
REWRITINGS = [
    ("{x: g*sin(alpha)/2,", "{x: R*g*sin(alpha)/(R + R),"),
    ("{rolling: -M*g*sin(alpha)/2}", "{rolling: -M*g*tan(alpha)*cos(alpha)/2}"),
    ("2*x'' = g*sin(alpha)", "x'' = -R*theta'' + g*sin(alpha)"),
    ("slide: M*R*x' + M*R^2*theta' -", "slide: 7 + 2*M*R*x' -"),
    ("slide: M*R*x' + M*R^2*theta' - M*R*g*t", "slide: 3 - 2*M*x' + M*g*t"),
    ("energy: M*x'^2 - M*g*x", "energy: M*g*R + R*theta'^2/g*R - R*theta"),
]


def check(text):
    return check_problem("hoop.yaml", text.encode())


def changed(old, new):
    assert HOOP.count(old) >= 1
    return HOOP.replace(old, new, 1)


def test_the_unchanged_file_passes():
    report = check(HOOP)
    assert report.findings == ()
    assert report.outcome is CheckOutcome.PASSED


@pytest.mark.long
@pytest.mark.parametrize(("old", "new", "subject"), SLIPS, ids=[slip[1][:30] for slip in SLIPS])
def test_a_slip_is_found_where_it_stands(old, new, subject):
    text = changed(old, new)
    report = check(text)
    assert [(f.outcome, f.subject) for f in report.findings] == [(CheckOutcome.WRONG, subject)]
    line = text.splitlines()[report.findings[0].span.line - 1]
    assert (
        subject.rpartition(".")[2].replace("0", "2*x").replace("1", "M*x") in line or "3*x" in line
    )


@pytest.mark.long
@pytest.mark.parametrize(("old", "new"), REWRITINGS, ids=[new for _, new in REWRITINGS])
def test_another_way_to_write_it_is_no_slip(old, new):
    report = check(changed(old, new))
    assert report.findings == ()
