"""Equations, matrix form, accelerations, multipliers, constraint forces, degrees of freedom."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from mpmath import mpf

from lagcli.reader import parse_equation_text

from .evaluate import Moment
from .examine import Examination, agree, named_multipliers
from .jets import Number, real_part
from .linear import Matrix, rank, solve
from .reference import gradient, rate
from .states import State, reals, with_random_accelerations


def check(x: Examination) -> None:
    """Everything about the motion itself."""
    if "lagrangian" in x.sheet:
        x.compare("lagrangian", x.sheet["lagrangian"], lambda s: x.reference.lagrangian(s.moment))
    _degrees_of_freedom(x)
    if "equations" in x.sheet:
        _equations(x)
    if "matrix_form" in x.sheet:
        _matrix_form(x)
    if "accelerations" in x.sheet:
        _accelerations(x)
    if "multipliers" in x.sheet:
        _multipliers(x)
    if "constraint_forces" in x.sheet:
        _constraint_forces(x)


def jacobian(x: Examination, moment: Moment) -> Matrix:
    """The rows a_kj of all constraints."""
    return [reals(x.reference.row(c, moment)) for c in x.problem.constraints]


def _degrees_of_freedom(x: Examination) -> None:
    size = x.reference.size
    for state in x.states:
        free = size - rank(jacobian(x, state.moment), size)
        if x.sheet["degrees_of_freedom"] != free:
            x.wrong("degrees_of_freedom", f"{x.sheet['degrees_of_freedom']}, the rank says {free}")


def _equations(x: Examination) -> None:
    """Both sides at states with accelerations and multipliers that no law gave."""
    listed = [entry["coordinate"] for entry in x.sheet["equations"]]
    if listed != list(x.reference.names):
        x.wrong("equations", f"for {listed}")
    for state in x.states:
        moment = with_random_accelerations(state.moment, seed=2)
        multipliers = [mpf(k + 2) / 7 for k in range(len(x.problem.constraints))]
        moment = named_multipliers(x.reference, moment, multipliers)
        inertia = reals(x.reference.inertia(moment))
        forces = reals(x.reference.applied(moment))
        for a, multiplier in zip(jacobian(x, moment), multipliers, strict=True):
            forces = [f + multiplier * component for f, component in zip(forces, a, strict=True)]
        for j, entry in enumerate(x.sheet["equations"]):
            where = f"equations.{entry['coordinate']}"
            equation = parse_equation_text(entry["equation"])
            left = x.number(where, equation.left, moment)
            right = x.number(where, equation.right, moment)
            if left is None or right is None:
                continue
            if not agree(left - right, inertia[j] - forces[j]):
                x.wrong(where, f"{entry['equation']} does not follow")


def _matrix_form(x: Examination) -> None:
    form = x.sheet["matrix_form"]
    if form is None:
        x.missing("matrix_form")
        return
    for state in x.states:
        moment = state.moment
        for name, text in form.get("shared", {}).items():
            node = x.read(f"matrix_form.shared.{name}", text)
            value = None if node is None else x.number("matrix_form.shared", node, moment)
            if value is None:
                return
            moment = replace(moment, extra={**moment.extra, name: value})
        still = replace(state.moment, chain=(*state.moment.chain[:2], (mpf(0),) * x.reference.size))
        inertia = x.reference.inertia(still)
        applied = x.reference.applied(still)
        truths: dict[str, list[list[Number]]] = {
            "mass_matrix": x.reference.mass_matrix(still),
            "constraint_jacobian": [x.reference.row(c, still) for c in x.problem.constraints],
            "forcing": [[f - e for f, e in zip(applied, inertia, strict=True)]],
            "constraint_bias": [[x.reference.bias(c, still) for c in x.problem.constraints]],
        }
        for part, truth in truths.items():
            printed = form[part] if part in {"mass_matrix", "constraint_jacobian"} else [form[part]]
            if [len(row) for row in printed] != [len(row) for row in truth]:
                x.wrong(f"matrix_form.{part}", "has another shape")
                continue
            for i, row in enumerate(printed):
                for j, text in enumerate(row):
                    where = f"matrix_form.{part}[{i}][{j}]"
                    node = x.read(where, text)
                    value = None if node is None else x.number(where, node, moment)
                    if value is not None and not agree(value, real_part(truth[i][j])):
                        x.wrong(where, f"{text} is not {real_part(truth[i][j])}")


def _accelerations(x: Examination) -> None:
    printed = x.sheet["accelerations"]
    regular = all(state.regular for state in x.states)
    if regular is (x.sheet.get("regular") is False):
        x.wrong("regular", f"the equations {'do' if regular else 'do not'} determine q''")
    if printed is None:
        if regular:
            x.missing("accelerations")
        return
    for j, name in enumerate(x.reference.names):
        where = f"accelerations.{name}"
        if printed.get(name) is None:
            x.missing(where)
        elif not all(state.motion.determined(j) for state in x.states):
            x.wrong(where, f"{printed[name]}, but it is not determined")
        else:
            x.compare(where, printed[name], lambda s, j=j: s.accelerations[j])


def _multipliers(x: Examination) -> None:
    size = x.reference.size
    for k, constraint in enumerate(x.problem.constraints):
        where = f"multipliers.{constraint.name}"
        entry = x.sheet["multipliers"].get(constraint.name)
        if entry is None:
            x.missing(where, "not listed")
            continue
        if entry["symbol"] != constraint.multiplier:
            x.wrong(where, f"is called {entry['symbol']}")
        determined = all(s.motion.consistent and s.motion.determined(size + k) for s in x.states)
        if entry["value"] is None:
            if determined:
                x.missing(where)
        elif not determined:
            x.wrong(where, f"{entry['value']}, but it is not determined")
        else:
            x.compare(where, entry["value"], lambda s, k=k: s.multipliers[k])
        kind = true_kind(x, k)
        if kind is not None and entry["kind"] != kind:
            x.wrong(where + ".kind", f"{entry['kind']}, true is {kind}")
    _redundant(x)


def _redundant(x: Examination) -> None:
    size = x.reference.size
    rows = jacobian(x, x.states[0].moment)
    dependent = len(rows) - rank(rows, size)
    named = x.sheet.get("redundant", [])
    if len(named) != dependent:
        x.wrong("redundant", f"{named}, but {dependent} are")


def true_kind(x: Examination, k: int) -> str | None:
    """Holonomic, integrable or nonholonomic by Frobenius; None where one step does not decide.

    With w_i the forms of all constraints, c . w is in the derived system when
    sum_i c_i dw_i vanishes on the kernel of all w.
    """
    constraint = x.problem.constraints[k]
    if x.reference.holonomic(constraint):
        return "holonomic"
    size = x.reference.size
    constraints = x.problem.constraints
    verdicts = set()
    for state in x.states:
        forms = [_form(x, state, i) for i in range(len(constraints))]
        curls = [_curl(x, state, i) for i in range(len(constraints))]
        kernel = solve(forms, [mpf(0)] * len(forms), size + 1).kernel
        columns = [[_on(curl, u, v) for curl in curls] for u, v in combinations(kernel, 2)]
        derived = solve(columns, [mpf(0)] * len(columns), len(constraints)).kernel
        independent = rank(forms, size + 1)
        combined = [
            [
                sum((c * w[j] for c, w in zip(cs, forms, strict=True)), mpf(0))
                for j in range(size + 1)
            ]
            for cs in derived
        ]
        inside = rank(combined, size + 1)
        if inside == independent:
            verdicts.add("integrable")
        elif rank([*combined, forms[k]], size + 1) > inside:
            verdicts.add("nonholonomic")
        else:
            verdicts.add("undecided")
    verdict = verdicts.pop() if len(verdicts) == 1 else "undecided"
    return None if verdict == "undecided" else verdict


def _form(x: Examination, state: State, i: int) -> list[mpf]:
    """(a_1, ..., a_n, b) of the form a dq + b dt."""
    constraint = x.problem.constraints[i]
    row = reals(x.reference.row(constraint, state.moment))
    at_rest = replace(
        state.moment, chain=(state.moment.chain[0], *((mpf(0),) * len(row) for _ in range(2)))
    )
    return [*row, real_part(x.reference.velocity_form(constraint)(at_rest))]


def _curl(x: Examination, state: State, i: int) -> Matrix:
    """dw_ij = d_i w_j - d_j w_i in the variables (q, t)."""
    constraint = x.problem.constraints[i]
    size = x.reference.size
    zero = (mpf(0),) * size
    at_rest = replace(state.moment, chain=(state.moment.chain[0], zero, zero))

    def component(j: int) -> list[mpf]:
        """The derivatives of w_j by (q, t)."""

        def w(m: Moment) -> Number:
            form = x.reference.velocity_form(constraint)
            return form(m) if j == size else gradient(form, m, 1)[j]

        # At rest, the rate along the motion is the explicit one.
        return [*reals(gradient(w, at_rest, 0)), real_part(rate(w, at_rest))]

    slopes = [component(j) for j in range(size + 1)]
    return [[slopes[j][i] - slopes[i][j] for j in range(size + 1)] for i in range(size + 1)]


def _on(curl: Matrix, u: list[mpf], v: list[mpf]) -> mpf:
    return sum((curl[i][j] * u[i] * v[j] for i in range(len(u)) for j in range(len(v))), mpf(0))


def _constraint_forces(x: Examination) -> None:
    size = x.reference.size
    constraints = x.problem.constraints
    printed = x.sheet["constraint_forces"] or {}
    for k, constraint in enumerate(constraints):
        determined = all(s.motion.consistent and s.motion.determined(size + k) for s in x.states)
        forces = printed.get(constraint.name)
        for j, name in enumerate(x.reference.names):
            where = f"constraint_forces.{constraint.name}.{name}"
            if forces is None or forces.get(name) is None:
                if determined:
                    x.missing(where)
                continue

            def force(s: State, k: int = k, j: int = j) -> Number:
                return s.multipliers[k] * jacobian(x, s.moment)[k][j]

            if determined:
                x.compare(where, forces[name], force)
    if not constraints or not all(s.regular for s in x.states):
        return
    total = x.sheet.get("total_constraint_force")
    if total is None:
        x.missing("total_constraint_force")
        return
    for j, name in enumerate(x.reference.names):

        def everything(s: State, j: int = j) -> Number:
            rows = jacobian(x, s.moment)
            return sum((m * a[j] for m, a in zip(s.multipliers, rows, strict=True)), mpf(0))

        x.compare(f"total_constraint_force.{name}", total.get(name), everything)
