"""Problems as the pictures get them."""

from lagcli.pipeline import read, with_lagrangian


def problem_of(text):
    found = read("problem.yaml", text.encode())
    assert found.problem is not None, found.diagnostics
    return with_lagrangian(found.problem)
