"""How a mistake is shown: its place, its line, carets under it, and advice."""

import pytest

from lagcli.diagnostics import NOWHERE, Diagnostic, Source, Span, render


def shown(text: str, start: int, end: int, hint: str = "", line: int = 1) -> str:
    span = Span(line, start, line, end)
    return render(Source("f.yaml", text), [Diagnostic("wrong", span, hint)])


def test_the_example_of_the_contract():
    text = "\n" * 13 + "V: M*g*(l - x)*sin(tetha)\n"
    span = Span(14, 20, 14, 25)
    diagnostic = Diagnostic("unknown name 'tetha' in V", span, "did you mean 'theta'?")
    assert render(Source("hoop.yaml", text), [diagnostic]) == (
        "hoop.yaml:14:20: error: unknown name 'tetha' in V\n"
        "   14 | V: M*g*(l - x)*sin(tetha)\n"
        "      |                    ^^^^^ did you mean 'theta'?\n"
    )


@pytest.mark.parametrize(
    ("line", "start", "carets"),
    [
        ("ab xy", 4, "   ^"),
        ("\tx", 2, "    ^"),
        ("中文 x", 4, "     ^"),
        ("e\u0301 x", 4, "  ^"),
        ("中", 1, "^^"),
    ],
)
def test_carets_stand_under_the_place(line, start, carets):
    assert shown(line, start, start + 1).splitlines()[2] == "      | " + carets


def test_a_terminal_is_told_nothing():
    assert "\x1b" not in shown("a\x1b[31m\x07\x9b\u202eb", 2, 3)
    hostile = Diagnostic("name '\x1b[2J'", Span(1, 1, 1, 2), "\x1b]0;x\x07")
    out = render(Source("\x1b[1m.yaml", "x"), [hostile])
    assert not any(ord(character) < 32 and character != "\n" for character in out)


def test_a_long_line_is_cut_around_the_place():
    out = shown("a" * 5000 + " tetha " + "b" * 5000, 5002, 5007).splitlines()
    assert len(out[1]) < 120
    column = out[2].index("^")
    assert out[1][column : column + 5] == "tetha"


def test_a_long_place_is_cut():
    out = shown("x" * 5000, 1, 5001).splitlines()
    assert all(len(line) < 120 for line in out)


def test_a_place_over_several_lines_is_marked_on_the_first():
    diagnostic = Diagnostic("wrong", Span(1, 2, 3, 1))
    lines = render(Source("f.yaml", "abc\ndef\n"), [diagnostic]).splitlines()
    assert lines[1:] == ["    1 | abc", "      |  ^^"]


def test_a_place_at_the_end_of_the_file():
    diagnostic = Diagnostic("wrong", Span(9, 1, 9, 1))
    assert render(Source("f.yaml", "a\n"), [diagnostic]).startswith("f.yaml:9:1: error: wrong\n")


def test_no_place():
    assert render(Source("-", ""), [Diagnostic("wrong", NOWHERE, "right")]) == (
        "-: error: wrong\n      = right\n"
    )


def test_related_places_follow_as_notes():
    diagnostic = Diagnostic("twice", Span(2, 1, 2, 2), related=((Span(1, 1, 1, 2), "first here"),))
    lines = render(Source("f.yaml", "x\nx\n"), [diagnostic]).splitlines()
    assert lines[0] == "f.yaml:2:1: error: twice"
    assert lines[3] == "f.yaml:1:1: note: first here"


def test_many_are_counted():
    many = [Diagnostic("wrong", Span(1, 1, 1, 2))] * 60
    assert render(Source("f.yaml", "x"), many).endswith("and 10 more\n")


def test_every_error_of_a_problem_survives_the_way_from_another_process():
    """Also those whose own arguments are others: an H that gives no Lagrangian."""
    import pickle

    import lagcli
    from lagcli.diagnostics import ProblemError
    from lagcli.mechanics.from_hamiltonian import with_lagrangian

    problem = lagcli.loads("coordinates: [x]\nH: x*p_x\n")
    with pytest.raises(ProblemError) as caught:
        with_lagrangian(problem)
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is type(caught.value)
    assert (str(again), again.reason) == (str(caught.value), caught.value.reason)
