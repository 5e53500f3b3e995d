"""What is exported of a problem: functions with their formulas, from the printed answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy

from lagcli.algebra.build import Builder
from lagcli.export.identifiers import identifiers
from lagcli.expression import Call, Expression, Name, PartialCall, walk
from lagcli.problem_data import Problem
from lagcli.record import record
from lagcli.rewriting import rebuilt
from lagcli.statements.answers import Answers


class NoCode(Exception):
    """Why a problem has no code, in a sentence."""


@record(kw_only=True)
class Routine:
    """One function: its name, what it gives, and a formula for each place of the result.

    Attributes
    ----------
    name, meaning : str
    rows, columns : int
        The shape of the result; `columns` is 0 for a vector.
    formulas : tuple of SymPy expressions
        Row by row.
    labels : tuple of str
        What stands in each row.
    """

    name: str
    meaning: str
    rows: int
    columns: int
    formulas: tuple[Any, ...]
    labels: tuple[str, ...]


@record(kw_only=True)
class Code:
    """A problem ready to be written in any language.

    Attributes
    ----------
    title : str
    module : str
        The identifier of the whole.
    state, parameters : tuple of str
        Identifiers in the order of y and p.
    names : mapping of str to str
        Identifier -> the name in the file.
    values : mapping of str to float
        Identifier of a parameter or a part of the state -> the number that the file gives.
    routines : tuple of Routine
    missing : str
        Why there are no accelerations; empty where there are.
    left_out : str
        What the file has and the code has not; empty where that is nothing.
    """

    title: str
    module: str
    state: tuple[str, ...]
    parameters: tuple[str, ...]
    names: Mapping[str, str]
    values: Mapping[str, float]
    routines: tuple[Routine, ...]
    missing: str = ""
    left_out: str = ""


#: What the answers must hold.
SECTIONS = ("matrix_form", "accelerations", "multipliers", "energy", "charges")


def code_of(problem: Problem, answers: Answers, module: str) -> Code:
    """The functions of a problem.

    Parameters
    ----------
    problem : Problem
        With its Lagrangian.
    answers : Answers
        With `SECTIONS`.
    module : str
        A name for the whole, such as that of the file.

    Raises
    ------
    NoCode
        When a function of the file is left unspecified.
    """
    coordinates = [one.name for one in problem.coordinates]
    state = [*coordinates, *(f"{name}'" for name in coordinates)]
    words = identifiers([*state, *answers.parameters])
    formulas = _Formulas(problem, words)
    routines = [*_motion(answers, formulas, state), *_matrices(answers, formulas)]
    routines += _quantities(answers, formulas)
    missing = "" if routines and routines[0].name == "rhs" else "; ".join(answers.warnings)
    return Code(
        title=answers.title,
        module=identifiers([module.replace("-", "_").replace(" ", "_") or "problem"]).popitem()[1],
        state=tuple(words[name] for name in state),
        parameters=tuple(words[name] for name in answers.parameters),
        names={word: name for name, word in words.items()},
        values=_values(problem, words),
        routines=tuple(routines),
        missing=missing,
        left_out=_left_out(problem),
    )


def _left_out(problem: Problem) -> str:
    contacts = ", ".join(each.name for each in problem.contacts)
    held = ", ".join(c.name for c in problem.constraints if c.holds_while is not None)
    sentences = [
        f"The contacts ({contacts}) are left out: this is the motion between impacts."
        if contacts else "",
        f"The constraints ({held}) are not released where holds_while ends." if held else "",
    ]  # fmt: skip
    return " ".join(filter(None, sentences))


class _Formulas:
    """Turns trees into SymPy expressions of the identifiers."""

    def __init__(self, problem: Problem, words: Mapping[str, str]) -> None:
        self.words = dict(words)
        self._unspecified = set(problem.functions)
        symbols = {word: sympy.Symbol(word, real=True) for word in self.words.values()}
        self._build = Builder(symbols, {}, _no_derivative)
        self.shared: dict[str, Any] = {}

    def __call__(self, tree: Expression) -> Any:
        for node in walk(tree):
            if isinstance(node, Call | PartialCall) and node.function in self._unspecified:
                raise NoCode(f"the function {node.function} is left unspecified: it has no code")
        found = self._build.knowing(self.shared)(self._named(tree))
        return found.replace(sympy.cot, lambda x: sympy.cos(x) / sympy.sin(x)).replace(
            sympy.sec, lambda x: 1 / sympy.cos(x)
        ).replace(sympy.csc, lambda x: 1 / sympy.sin(x))  # fmt: skip

    def share(self, name: str, tree: Expression) -> None:
        """Put a shared subexpression in wherever it occurs from now on."""
        self.shared[name] = self(tree)

    def _named(self, node: Expression) -> Expression:
        if isinstance(node, Name):
            return Name(self.words.get(str(node), node.name))
        return rebuilt(node, self._named)


def _no_derivative(value: Any) -> Any:
    raise TypeError(f"{value} has no derivative here")


def _motion(answers: Answers, formulas: _Formulas, state: Sequence[str]) -> list[Routine]:
    """The right-hand side of y' = f(t, y), its Jacobian, and the multipliers."""
    accelerations: Any = answers.sections["accelerations"]
    solved = accelerations.accelerations
    if solved is None:
        return []
    half = len(state) // 2
    velocities = [sympy.Symbol(formulas.words[name], real=True) for name in state[half:]]
    rhs = (*velocities, *(formulas(solved[name]) for name in state[:half]))
    symbols = [sympy.Symbol(formulas.words[name], real=True) for name in state]
    jacobian = tuple(_derivative(f, y) for f in rhs for y in symbols)
    labels = tuple(f"d({name})/dt" for name in state)
    found = [
        _vector("rhs", "right-hand side of the equations of motion, dy/dt", rhs, labels),
        Routine(
            name="jacobian", meaning="derivative of rhs with respect to y", rows=len(state),
            columns=len(state), formulas=jacobian, labels=labels,
        ),
    ]  # fmt: skip
    section: Any = answers.sections["multipliers"]
    multipliers = section.multipliers
    known = {
        one.symbol: formulas(one.value) for one in multipliers.values() if one.value is not None
    }
    if known:
        meaning = "multipliers of the constraints"
        found.append(_vector("multipliers", meaning, tuple(known.values()), tuple(known)))
    return found


def _derivative(formula: Any, symbol: Any) -> Any:
    """d/dx; what abs and sign have at their corners is left out."""
    found = formula.diff(symbol)
    return found.replace(sympy.DiracDelta, lambda *_: sympy.Integer(0))


def _matrices(answers: Answers, formulas: _Formulas) -> list[Routine]:
    """M q'' = forcing + A^T lambda, A q'' + bias = 0."""
    section: Any = answers.sections["matrix_form"]
    coordinates = answers.coordinates
    for name, tree in section.shared.items():
        formulas.share(name, tree)
    found = [
        _matrix("mass_matrix", "M in M q'' = forcing + A^T lambda", section.mass_matrix, formulas),
        _vector("forcing", "forcing in M q'' = forcing + A^T lambda",
                tuple(map(formulas, section.forcing)), coordinates),
    ]  # fmt: skip
    if section.constraint_jacobian:
        rows = section.constraint_jacobian
        bias = tuple(map(formulas, section.constraint_bias))
        labels = tuple(f"row {k}" for k in range(len(rows)))
        found += [
            _matrix("constraint_jacobian", "A in A q'' + bias = 0", rows, formulas),
            _vector("constraint_bias", "bias in A q'' + bias = 0", bias, labels),
        ]
    return found


def _quantities(answers: Answers, formulas: _Formulas) -> list[Routine]:
    """The energy function and the conserved charges."""
    energy: Any = answers.sections["energy"]
    charges: Any = answers.sections["charges"]
    found = []
    if energy.function is not None:
        meaning = "energy function, sum of q' dL/dq' minus L"
        found.append(_vector("energy", meaning, (formulas(energy.function),), ("energy",)))
    kept = {
        one.name: formulas(one.charge)
        for one in charges.charges or ()
        if one.conserved and one.charge is not None and one.name != "energy"
    }
    if kept:
        meaning = "conserved quantities"
        found.append(_vector("charges", meaning, tuple(kept.values()), tuple(kept)))
    return found


def _vector(name: str, meaning: str, formulas: tuple[Any, ...], labels: Sequence[str]) -> Routine:
    return Routine(
        name=name, meaning=meaning, rows=len(formulas), columns=0, formulas=formulas,
        labels=tuple(labels),
    )  # fmt: skip


def _matrix(name: str, meaning: str, rows: Any, formulas: _Formulas) -> Routine:
    return Routine(
        name=name, meaning=meaning, rows=len(rows), columns=len(rows[0]),
        formulas=tuple(formulas(entry) for row in rows for entry in row),
        labels=tuple(f"row {k}" for k in range(len(rows))),
    )  # fmt: skip


def _values(problem: Problem, words: Mapping[str, str]) -> dict[str, float]:
    from lagcli.evaluation import value_of
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.numerics.equations.start import completed_state
    from lagcli.values import numbers_of_parameters

    numbers: dict[str, float] = dict(numbers_of_parameters(problem))
    try:
        numbers |= completed_state(problem) if problem.initial else {}
    except Refusal:  # some of it depends on what has no value
        given = {str(name): value_of(tree) for name, tree in problem.initial.items()}
        numbers |= {name: float(value) for name, value in given.items() if value is not None}
    return {words[name]: value for name, value in numbers.items() if name in words}
