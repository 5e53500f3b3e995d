"""A problem as text, run as the command line runs it."""

from pathlib import Path

from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pipeline import Request, read, with_lagrangian
from lagcli.reader.columns import Column, read_along, read_columns, usual_columns

ROOT = Path(__file__).parents[2]


def problem_of(text, *settings):
    found = read("test.yaml", text.encode(), Request(settings=settings))
    assert found.problem is not None, found.diagnostics
    return found.problem


def simulated(text, until, accuracy=1e-9, show=None, samples=2, settings=(), stop=None, **asked):
    problem = with_lagrangian(problem_of(text, *settings))
    shown = usual_columns(problem) if show is None else read_columns(problem, [show])
    return simulate(
        problem,
        RunRequest(
            until=until,
            accuracy=accuracy,
            samples=samples,
            columns=tuple(Column(*each) for each in shown),
            stop_when=None if stop is None else read_along(problem, stop, "--stop-when"),
            stop_name=stop or "",
            **asked,
        ),
    )


def column(result, name):
    place = result.columns.index(name)
    return [row[place] for row in result.rows]


def last(result, name):
    return column(result, name)[-1]
