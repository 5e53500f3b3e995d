"""lagcli from Python: problems in, answers, motions and explanations out.

    import lagcli

    pendulum = lagcli.load("plane-pendulum")
    lagcli.solve(pendulum).accelerations["theta"]       # shows as mathematics in a notebook
    lagcli.simulate(pendulum, until=10).to_pandas()

Every function takes what `load`, `loads` or `problem` gives, or a path or a name to load.  What
goes wrong in a file is a `ProblemError`, whose message shows each mistake at its place; a motion
that cannot be computed as requested is a `Refusal`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from lagcli.diagnostics import ProblemError
from lagcli.interface.account import Account
from lagcli.interface.ensemble import Sweep, Vary, ensemble
from lagcli.interface.formula import Formula
from lagcli.interface.motion import Motion, integrate
from lagcli.interface.solution import Solution
from lagcli.numerics.equations.refusal import Refusal
from lagcli.problem_data import Problem
from lagcli.studies.check import Report

__all__ = [
    "Account", "Formula", "Motion", "Problem", "ProblemError", "Refusal", "Report", "Solution",
    "Sweep", "check", "explain", "load", "loads", "problem", "simulate", "solve", "sweep",
]  # fmt: skip

Values = Mapping[str, object]
Given = Problem | str | PathLike[str]


def load(path: str | PathLike[str]) -> Problem:
    """Read a problem file, or a problem of the library by its name.

    Raises
    ------
    OSError
        When there is no such file and no such name.
    ProblemError
        When the file is not a problem.

    Examples
    --------
    >>> load("kepler").title
    'Kepler problem with the Laplace-Runge-Lenz vector'
    """
    return _read(fspath(path), _bytes(path))


def loads(text: str) -> Problem:
    """Read a problem from its text in YAML.

    Raises
    ------
    ProblemError
        When the text is not a problem.

    Examples
    --------
    >>> loads("{coordinates: [x], T: x'^2/2}").kinetic is not None
    True
    """
    return _read("<text>", text.encode())


def problem(parts: Mapping[str, Any]) -> Problem:
    """Make a problem of a dictionary with the keys of the file format.

    Raises
    ------
    ProblemError
        When the dictionary is not a problem.

    Examples
    --------
    >>> oscillator = problem({"coordinates": ["x"], "T": "x'^2/2", "V": "x^2/2"})
    """
    import yaml

    text = yaml.safe_dump(_plain(parts), sort_keys=False, allow_unicode=True, width=10**6)
    return _read("<dictionary>", text.encode())


def solve(
    problem: Given,
    sections: Sequence[str] | str | None = None,
    *,
    values: Values | None = None,
    numeric: bool = False,
) -> Solution:
    """Derive what the sections say of a problem; each answer is verified.

    Parameters
    ----------
    problem : Problem, str or path
        As `load` gives it, or takes it.
    sections : str or sequence of str, optional
        Out of those that `lagcli help solve` lists, in one text with commas between them;
        the usual ones without it.
    values : mapping of str to number or str, optional
        Put in for parameters before anything is derived.
    numeric : bool
        Put in the values of the file as well, and give decimal numbers.

    Raises
    ------
    ProblemError
        When a value does not fit, or the constraints contradict each other.
    """
    from lagcli.pipeline import Request, derive, state
    from lagcli.reader.suggest import did_you_mean
    from lagcli.statements.registry import every_section, in_order

    if isinstance(sections, str):
        sections = [name.strip() for name in sections.split(",")]
    names = None if sections is None else tuple(sections)
    known = {each.name for each in in_order(names or ())}
    for name in names or ():
        if name not in known:
            every = [each.name for each in every_section()]
            hint = did_you_mean(name, every) or f"there are {', '.join(every)}"
            raise ValueError(f"unknown section {name!r}: {hint}")
    changed = _with_values(problem, values, numeric=numeric)
    request = Request(sections=names, numeric=numeric)
    return Solution(state(derive(changed), request), changed)


def simulate(
    problem: Given,
    until: float | str | None = None,
    *,
    accuracy: float | None = None,
    samples: int = 101,
    times: Sequence[float] = (),
    show: Sequence[str] | str = (),
    values: Values | None = None,
    at: Values | None = None,
    method: str = "auto",
    stop_when: str | None = None,
    project: bool = False,
    precision: int | None = None,
    whole_model: bool = False,
) -> Motion:
    """Compute the motion to a stated accuracy, with a certificate.

    Parameters
    ----------
    problem : Problem
        With a value for every parameter and an `initial` state, or with `values` and `at`.
    until : float or str, optional
        The end, in the file's unit of time; the file's own without it.
    accuracy : float, optional
        The bound on the global error of every number, relative to its column's largest
        magnitude; the file's own, or 1e-9.
    samples : int
        Rows, both ends included.
    times : sequence of float
        Rows at these times instead, from 0 to `until`.
    show : sequence of str or str
        Columns, as `lagcli simulate --show` takes them.
    values, at : mapping of str to number or str, optional
        Parameters, and coordinates and velocities at t = 0.
    method, stop_when, project, precision, whole_model
        As the options of `lagcli simulate`.

    Returns
    -------
    Motion
        Its rows end where the accuracy holds no longer; `refusal` then says why.

    Raises
    ------
    ProblemError
        When a column, a value or the state does not fit the problem.
    Refusal
        When no run can be made.
    """
    from lagcli.pipeline import with_lagrangian

    changed = with_lagrangian(_at(_with_values(problem, values), at))
    return integrate(
        changed,
        until=until,
        accuracy=accuracy,
        samples=samples,
        times=times,
        show=[show] if isinstance(show, str) and show else list(show),
        method=method,
        stop_when=stop_when,
        project=project,
        precision=precision,
        whole=whole_model,
    )


def sweep(
    problem: Given,
    vary: Vary,
    until: float | str | None = None,
    *,
    random: int | None = None,
    seed: int = 0,
    along: bool = False,
    samples: int = 101,
    times: Sequence[float] = (),
    stop_when: str | None = None,
    accuracy: float | None = None,
    show: Sequence[str] | str = (),
    values: Values | None = None,
    at: Values | None = None,
    method: str = "auto",
    jobs: int = 1,
) -> Sweep:
    """Compute an ensemble of motions over parameters and initial states.

    Parameters
    ----------
    problem : Problem
        As for `simulate`.
    vary : mapping of str to str or sequence of float
        Parameters, coordinates and velocities, each with its values or with a range such as
        `"0:3.14:200"` (first, last, count); the last varies fastest.
    until, accuracy, show, values, at, method
        As for `simulate`.
    random, seed : int
        So many draws between the ends of each range (`"0:3.14"`) instead.
    along : bool
        Every row of each motion, `samples` of them; its end otherwise.
    times : sequence of float
        Rows at these times instead; the last is the end.
    stop_when : str
        An expression: a motion ends where it changes its sign, at the time in the column `t`.
    jobs : int
        Processes.

    Raises
    ------
    ProblemError
        When a range, a column or a value does not fit the problem.
    """
    from lagcli.pipeline import with_lagrangian

    changed = with_lagrangian(_at(_with_values(problem, values), at))
    return ensemble(
        changed,
        vary,
        random=random,
        seed=seed,
        along=along,
        jobs=jobs,
        samples=samples,
        times=times,
        stop_when=stop_when,
        until=until,
        accuracy=accuracy,
        show=[show] if isinstance(show, str) and show else list(show),
        method=method,
    )


def explain(problem: Given, also: Sequence[str] = ()) -> Account:
    """Give the derivation step by step, with its reasons; `also` adds sections.

    Raises
    ------
    ProblemError
        When the constraints contradict each other.
    """
    from lagcli.pipeline import derive
    from lagcli.pipeline import explain as account

    return Account(account(derive(_problem(problem)), tuple(also)))


def check(problem: Given) -> Report:
    """Compare the answers to a file with its `expect` block, and with the mathematics."""
    from lagcli.studies.check.one import check_problem

    if isinstance(problem, Problem):
        return check_problem(problem.source.name, problem.source.text.encode())
    return check_problem(fspath(problem), _bytes(problem))


def _problem(given: Given) -> Problem:
    return given if isinstance(given, Problem) else load(given)


def _bytes(path: str | PathLike[str]) -> bytes:
    """A file, or a problem of the library."""
    from lagcli.library import find_problem

    file = Path(path)
    return (file if file.exists() else find_problem(fspath(path))).read_bytes()


def _read(name: str, data: bytes) -> Problem:
    from lagcli.reader import read_problem

    return read_problem(name, data).checked()


def _plain(value: object) -> object:
    """Numbers and names as the text that the format has for them."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, bool):
        return "yes" if value else "no"
    return _text(value)


def _text(value: object) -> str:
    """A value as an expression of the format; floats with every digit."""
    if isinstance(value, (Formula, str)):
        return value.grammar if isinstance(value, Formula) else value
    return repr(float(value)) if isinstance(value, float) else str(value)


def _with_values(given: Given, values: Values | None, *, numeric: bool = False) -> Problem:
    from lagcli.reader.settings import set_parameters
    from lagcli.values import parameters_with_values, with_values_of

    settings = [f"{name}={_text(value)}" for name, value in (values or {}).items()]
    changed = set_parameters(_problem(given), settings)
    names = dict.fromkeys(values or {})
    if numeric:
        names.update(dict.fromkeys(parameters_with_values(changed)))
    if not names:
        return changed
    found, wrong = with_values_of(changed, names)
    if wrong:
        raise ProblemError(changed.source, tuple(wrong))
    return found


def _at(problem: Problem, state: Values | None) -> Problem:
    from lagcli.reader.settings import set_state

    return set_state(problem, [f"{name}={_text(value)}" for name, value in (state or {}).items()])
