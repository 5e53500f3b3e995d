"""Lines that are none of the file: what is left of a merge, and comments of other languages."""

import pytest

from lagcli.reader import read_problem

TOP = "coordinates: [x]\nparameters:\n"
END = "T: m*x'^2/2\nV: k*x^2/2\n"
COMMENT = "a comment begins with '#'"


def told(written):
    return [(x.span.line, x.message, x.hint) for x in read_problem("p.yaml", written.encode())
            .diagnostics]  # fmt: skip


@pytest.mark.parametrize("ancestor", ["", "||||||| 1a2b3c\n  m: 3\n  k: 3\n"])
@pytest.mark.parametrize("second", ["  m: 2\n  k: 2\n", "  m: 2\n"])
def test_a_merge_conflict_is_one_mistake_with_the_lines_of_both_versions(ancestor, second):
    conflict = f"<<<<<<< HEAD\n  m: 1\n  k: 1\n{ancestor}=======\n{second}>>>>>>> other\n"
    [(line, message, hint)] = told(f"{TOP}{conflict}{END}")
    begin = 7 + ancestor.count("\n")
    other = f"lines {begin} to {begin + 1}" if "k" in second else f"line {begin}"
    assert (line, message) == (3, "a merge conflict is not resolved")
    assert hint.startswith(f"keep lines 4 to 5 or {other}, ")


def test_a_merge_conflict_hides_no_other_mistake():
    conflict = "<<<<<<< HEAD\n  m: 1\n=======\n  m: 2\n>>>>>>> other\n  k: 1\n"
    lines = [line for line, *_ in told(f"{TOP}{conflict}{END}initial: {{y: 1}}\n")]
    assert lines == [3, 11]


def test_a_mark_that_is_left_of_a_conflict_is_left_out():
    text = f"{TOP}  m: 1\n=======\n  k: 1\n{END}"
    assert told(text) == [(4, "this line is none of the file", "leave it out")]


@pytest.mark.parametrize("comment", ["! a: b", "! a", "// a: b", "/* a: b */", "/* a:\n b */"])
def test_a_comment_of_another_language_is_one_mistake(comment):
    given = f"{TOP}  m: 1\n  k: 1\n"
    wrong = ("this line is none of the file", COMMENT)
    assert told(f"{comment}\n{given}{END}") == [(1, *wrong)]
    assert told(f"{given}{comment}\n{END}") == [(5, *wrong)]


@pytest.mark.parametrize("mark", ["! potential", "// of the spring", "/* a, b */", "!a: b"])
def test_a_comment_behind_a_formula_is_left_out(mark):
    text = f"{TOP}  m: 1\n  k: 1\n{END.rstrip()}  {mark.replace(': ', ' ')}\n"
    assert [hint for *_, hint in told(text)] == [f"{COMMENT}: write k*x^2/2"]


@pytest.mark.parametrize("breaks", [" + &\n  ", " &\n  & + ", " + &\n  & "])
def test_a_line_that_goes_on_has_no_mark(breaks):
    text = f"{TOP}  m: 1\n  k: 1\n{END.rstrip()}{breaks}m*x\n"
    assert [hint for *_, hint in told(text)] == ["write k*x^2/2 + m*x"]
