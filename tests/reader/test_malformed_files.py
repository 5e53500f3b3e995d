"""Files that break the contract: each is answered with a place and a sentence.

A case is the file's text, the place `line:column`, and a piece of the message or its hint.
"""

import pytest

from lagcli.diagnostics import render
from lagcli.reader import read_problem

GOOD = """\
coordinates: [x, y]
parameters: {m: {assume: positive}, g: 9.81}
functions: {U: [r], W: [a, b]}
definitions: {r: sqrt(x^2 + y^2), d: x' + y}
T: m*(x'^2 + y'^2)/2
constraints: {line: x + y}
symmetries: {shift: {x: 1, y: -1}}
find: {height: {where: x' = 0, for: x}}
"""


def after(addition: str) -> str:
    """A good file of eight lines, and from the ninth on what is wrong."""
    return GOOD + addition


def one_sided(attributes: str) -> str:
    """A good file whose constraint, in the sixth line, has attributes."""
    return GOOD.replace("{line: x + y}", f"{{line: {{equation: x + y, {attributes}}}}}")


def asked(question: str) -> str:
    """A good file whose question, in the eighth line, is another one."""
    return GOOD.replace("height: {where: x' = 0, for: x}", f"a: {{{question}}}")


CANONICAL = "coordinates: [x]\nL: x'^2\ncanonical_transformations: {a: {Q: x, p_Q: p_x}}\n"

FILES = [
    # The numerical run.
    (after("simulation: {until: 1, method: euler}\n"), "9:32", "'method' has no value 'euler'"),
    (after("simulation: {method: tailor}\n"), "9:22", "did you mean 'taylor'?"),
    # Phase space.
    (after("observables: {A: x*p_y - y*px}\n"), "9:28", "unknown name 'px'"),
    (after("observables: {A: x*p_y, B: A'}\n"), "9:28", "no primes"),
    (after("observables: {A: x'}\n"), "9:18", "no velocities"),
    (after("observables: {p_x: x}\n"), "9:15", "the momentum of the coordinate 'x'"),
    (after("observables: {x: y}\n"), "9:15", "declared twice"),
    (after("observables: {A: x}\nV: A\n"), "10:4", "'A' cannot stand in V"),
    (after("brackets: {a: [x]}\n"), "9:15", "has 1 function, not 2"),
    (after("brackets: {a: [x, shft]}\n"), "9:19", "did you mean 'shift'"),
    (after("brackets: {a: x}\n"), "9:15", "must be a list"),
    (after("canonical_transformations: {a: {Q: x, p_Q: p_x}}\n"), "9:29", "has 1 new coordinate,"),
    (after("canonical_transformations: {a: {Q: x, R: y, p_R: p_y}}\n"), "9:33", "'p_Q' of 'Q' is"),
    (after("canonical_transformations: {a: {p_Q: x}}\n"), "9:33", "no coordinate 'Q'"),
    (after("canonical_transformations: {a: {x: p_x, p_x: -x}}\n"), "9:33", "already"),
    (after("canonical_transformations: {a: {Q: x'}}\n"), "9:36", "no velocities"),
    (
        "coordinates: [x]\nL: x'^2\ncanonical_transformations:\n  a: {Q: p_x, p_Q: -x, F1: x*p_Q}\n",
        "4:30",
        "F1 is a function of coordinates and new coordinates",
    ),
    (
        "coordinates: [x]\nL: x'^2\ncanonical_transformations:\n  a: {Q: p_x, p_Q: -x, F1: x*Q, F2: 1}\n",
        "4:33",
        "two generating functions",
    ),
    (
        CANONICAL + "expect: {canonical: {a: {kind: canonicle}}}\n",
        "4:32",
        "did you mean 'canonical'",
    ),
    # H instead of T and V.
    (after("H: p_x^2/2\n"), "5:1", "H and T are given"),
    ("coordinates: [x]\nL: x'^2\nH: p_x^2\n", "2:1", "H and L are given"),
    ("coordinates: [x]\nV: x^2\nH: p_x^2\n", "2:1", "H and V are given"),
    ("coordinates: [x]\nH: p_x^2/2 + x'\n", "2:14", "the velocity x' cannot stand in H"),
    ("coordinates: [x]\ndefinitions: {v: x'}\nH: p_x^2/2 + v\n", "3:14", "contains a velocity"),
    ("coordinates: [x]\nH: p_y^2/2\n", "2:4", "unknown name 'p_y' in H"),
    ("coordinates: [x]\nH: p_x'^2/2\n", "2:4", "a momentum has no primes"),
    # The file as a whole.
    ("", "1:1", "empty"),
    ("# nothing\n", "1:1", "empty"),
    ("- x\n- y\n", "1:1", "must be a map"),
    ("x\n", "1:1", "must be a map"),
    ("--- {}\n--- {}\n", "2:1", "second document"),
    (after("V: g\x1b[31m\n"), "9:5", "U+001B"),
    (after("V: [x\n"), "9:4", "never closed"),
    (after("V: 'x\n"), "9:4", "never closed"),
    (after("V: a: b\n"), "9:5", "second ':'"),
    (after("\tV: x\n"), "9:1", "tab"),
    (after("V: @x\n"), "9:4", "cannot begin"),
    (after("V: *nowhere\n"), "9:4", "no anchor"),
    (after("V: &a [*a]\n"), "9:8", "inside of what it names"),
    (after("V: !!python/object/apply:os.system [ls]\n"), "9:4", "tags"),
    (after("g: &a x\nV: !foo x\n"), "10:4", "tags"),
    (after("? [a, b]\n: x\n"), "9:3", "a key must be a text"),
    (after("T: x\n"), "9:1", "given twice"),
    (after("Tee: x\n"), "9:1", "unknown key 'Tee'"),
    (after("symetries: {}\n"), "9:1", "did you mean 'symmetries'"),
    (after("<<: {}\n"), "9:1", "merge key"),
    ("T: 1\n", "1:1", "no coordinates"),
    ("coordinates: []\nT: 1\n", "1:14", "no coordinates"),
    ("coordinates: x\nT: 1\n", "1:14", "write [x]"),
    ("coordinates: [x]\n", "1:1", "no kinetic energy"),
    ("coordinates: [x]\npoints: {p: {position: [x]}}\n", "2:10", "no mass"),
    (after("L: x\n"), "5:1", "L and T are given"),
    # Names.
    ("coordinates: [x, x]\nT: x'^2\n", "1:18", "declared twice"),
    ("coordinates: [sin]\nT: 1\n", "1:15", "cannot be declared"),
    ("coordinates: [t]\nT: 1\n", "1:15", "the time"),
    ("coordinates: [x']\nT: 1\n", "1:15", "without primes"),
    ("coordinates: [2x]\nT: 1\n", "1:15", "begin with a digit"),
    ("coordinates: [a-b]\nT: 1\n", "1:15", "letters, digits and underscores"),
    ("coordinates: [x]\nparameters: [p_x]\nT: x'^2\n", "2:14", "momentum"),
    ("coordinates: [x]\nparameters: [lambda_a]\nT: x'^2\nconstraints: {a: x}\n", "4:15", "twice"),
    ("coordinates: [x]\nfunctions: {U: x}\nT: x'^2\nV: U(x)\n", "2:16", "write [x]"),
    # Attributes.
    ("coordinates: {x: {units: m}}\nT: x'^2\n", "1:19", "did you mean 'unit'"),
    ("coordinates: {x: {assume: positiv}}\nT: x'^2\n", "1:27", "did you mean 'positive'"),
    ("coordinates: {x: {symbol: '\\input{a}'}}\nT: x'^2\n", "1:27", "simple LaTeX"),
    ("coordinates: {x: {description: up, down}}\nT: x'^2\n", "1:36", "comma ends the value"),
    ("coordinates: [x]\nparameters: {a: b, b: a}\nT: x'^2\n", "2:17", "needs itself"),
    ("coordinates: [x]\nparameters: {a: x}\nT: x'^2\n", "2:17", "only numbers and parameters"),
    (
        "coordinates: [x]\nparameters: {a: {integer: 1}}\nT: x'^2\n",
        "2:27",
        "write yes, no, true or false",
    ),
    # Expressions.
    (after("V: m*g*tetha\n"), "9:8", "unknown name 'tetha' in V"),
    (after("V: 2 x\n"), "9:4", "did you mean 2*x?"),
    (after("V: 2x\n"), "9:4", "did you mean 2*x?"),
    (after("V: x y\n"), "9:4", "did you mean x*y?"),
    (after("V: 2(x)\n"), "9:4", "did you mean 2*x?"),
    (after("V: (x)(y)\n"), "9:6", "'*' is missing"),
    (after("V: sin x\n"), "9:4", "did you mean sin(x)?"),
    (after("V: sin^2(x)\n"), "9:4", "write sin(x)^2"),
    (after("V: Diff(x, y)\n"), "9:4", "did you mean diff(…)?"),
    (after("V: xdot\n"), "9:4", "write x'"),
    (after("V: x(y)\n"), "9:4", "did you mean x*(…)?"),
    (after("V: m·g\n"), "9:5", "write m*g"),
    (after("V: x²\n"), "9:4", "write x^2"),
    (after("V: (x\n"), "9:4", "never closed"),
    (after("V: x)\n"), "9:5", "never opened"),
    (after("V: x +\n"), "9:6", "nothing follows '+'"),
    (after("V: x = y\n"), "9:6", "only in constraints and equations"),
    (after("V: x > y\n"), "9:6", "only in 'holds_while'"),
    (after("V:\n"), "9:3", "V is empty"),
    (after("V: [x]\n"), "9:4", "must be an expression, not a list"),
    (after("V: sin(x, y)\n"), "9:4", "takes 1 argument, not 2"),
    (after("V: sinn(x)\n"), "9:4", "did you mean sin(…)?"),
    (after("V: sin\n"), "9:4", "write sin(…)"),
    (after("V: U\n"), "9:4", "needs arguments"),
    (after("V: W'(x, y)\n"), "9:4", "function of one argument"),
    (after("V: diff(W, 3)(x, y)\n"), "9:4", "no argument number 3"),
    (after("V: diff(W, 1)\n"), "9:4", "needs its arguments"),
    (after("V: diff(x, 2*x)\n"), "9:12", "by a name"),
    (after("V: g'\n"), "9:4", "a parameter is constant"),
    (after("V: x''\n"), "9:4", "the acceleration x''"),
    (after("V: d'\n"), "9:4", "contains an acceleration"),
    (after("V: p_x\n"), "9:4", "the momentum"),
    (after("V: 1/0\n"), "9:6", "division by zero"),
    (after("V: x/(2 - 2)\n"), "9:6", "division by zero"),
    (after("V: log(0)\n"), "9:4", "not a number"),
    (after("V: x + exp(cosh(2^(exp(x))))\n"), "9:8", "more than 3 exponentials"),
    (after("V: y^(m^(g^(x^y)))\n"), "9:4", "more than 3 exponentials"),
    (
        GOOD.replace("d: x' + y", "a: exp(x), b: exp(a), d: x' + y") + "V: exp(sinh(b))\n",
        "9:4",
        "more than 3 exponentials",
    ),
    (after("V: x/0 + y/0 + log(0)\n"), "9:6", "division by zero"),
    (after("V: x/0 + y/0 + log(0)\n"), "9:12", "division by zero"),
    (after("V: x/0 + y/0 + log(0)\n"), "9:16", "not a number"),
    (after('V: "x + \\\n  yy"\n'), "10:3", "unknown name 'yy'"),
    (after("V: 'x'' + zz'\n"), "9:11", "unknown name 'zz'"),
    (after("V: >\n  x\n  + zz\n"), "11:5", "unknown name 'zz'"),
    (after("V: |2\n  x\n  + zz\n"), "11:5", "unknown name 'zz'"),
    (after("V: x\n  + zz\n"), "10:5", "unknown name 'zz'"),
    # Sections.
    (after("forces: {x: atan2(y, x)}\n"), "9:13", "a comma ends the value"),
    (after("forces: {z: x}\n"), "9:10", "not a coordinate"),
    (after("points: {p: {position: x}}\n"), "9:24", "write [x]"),
    (after("points: {p: {position: [x']}}\n"), "9:25", "the velocity x'"),
    (after("points: {p: {position: [x, y, x, y]}}\n"), "9:24", "1 to 3"),
    (after("points: {p: {position: [x, y], force: [x]}}\n"), "9:39", "its position has 2"),
    (after("contacts: {f: x'}\n"), "9:15", "the velocity x'"),
    (after("contacts: {f: m >= 0}\n"), "9:15", "contains no coordinate"),
    (after("contacts: {f: {gapp: x}}\n"), "9:16", "did you mean 'gap'"),
    (after("contacts: {f: {restitution: 1}}\n"), "9:12", "has no gap"),
    (after("contacts: {line: x >= 0}\n"), "9:12", "is a constraint already"),
    (after("contacts: {f: {gap: x, restitution: y}}\n"), "9:37", "only numbers and parameters"),
    (after("contacts: {f: {gap: x, restitution: 3}}\n"), "9:37", "between 0 and 1, and is 3"),
    (after("contacts: {f: {gap: x, restitution: -g}}\n"), "9:37", "is -981/100"),
    (
        one_sided("holds_while: lambda_line >= 0, on_loss: release, restitution: 3/2"),
        "6:101",
        "between 0 and 1, and is 3/2",
    ),
    (GOOD.replace("{assume: positive}", "{assume: positive, value: -1}"), "2:43", "is positive"),
    (after("contacts: {f: {gap: x, multiplier: y}}\n"), "9:36", "declared twice"),
    (after("contacts: {f: x >= 0}\nV: lambda_f\n"), "10:4", "cannot stand in V"),
    (asked("always: x > 0"), "8:8", "has no 'for'"),
    (asked("reaches: x = 1"), "8:8", "has no 'for'"),
    (asked("always: x = 0, for: m"), "8:22", "'=' stands only"),
    (asked("always: x > 0, for: x"), "8:32", "is not a parameter"),
    (asked("always: x > q, for: m"), "8:24", "unknown name 'q'"),
    (asked("reaches: x' = 1, for: m"), "8:21", "velocity x'"),
    (asked("reaches: x + y = 1, for: m"), "8:21", "a coordinate alone"),
    (asked("reaches: x = y, for: m"), "8:21", "has no coordinate"),
    (asked("always: x > 0, for: m") + "expect: {find: {a: [y > 0]}}\n", "9:21", "a bound of m"),
    (asked("always: x > 0, for: m") + "expect: {find: {a: [m > x]}}\n", "9:25", "coordinate x"),
    (one_sided("acts_as: frictoin"), "6:48", "did you mean 'friction'"),
    (one_sided("acts_as: magic"), "6:48", "write normal, friction or tension"),
    (after("expect: {forces: {lin: {a: 1}}}\n"), "9:19", "did you mean 'line'"),
    (after("expect: {forces: {line: {a: 1}}}\n"), "9:26", "there is no point 'a'"),
    (after("expect: {friction_needed: {mud: 1}}\n"), "9:28", "there is no constraint 'mud'"),
    (one_sided("on_loss: release"), "6:48", "needs 'holds_while'"),
    (one_sided("holds_while: lambda_line > 0, on_loss: relase"), "6:78", "did you mean 'release'"),
    (one_sided("holds_while: lambda_line > 0, restitution: 1"), "6:82", "on_loss: release"),
    (one_sided("holds_while: x > 0, on_loss: release, restitution: 1"), "6:90", "side"),
    (after("expect: {trajectory: {x: y}}\n"), "9:26", "depends on t and parameters"),
    (after("expect: {trajectory: {z: t}}\n"), "9:23", "unknown name 'z'"),
    (after("expect: {trajectory: {at: [{x: 1}]}}\n"), "9:28", "has no time"),
    (after("expect: {trajectory: {events: [{name: lin}]}}\n"), "9:39", "did you mean 'line'"),
    (after("expect: {trajectory: {events: [{what: imact}]}}\n"), "9:39", "did you mean 'impact'"),
    (after("initial: {x: y}\n"), "9:14", "only numbers and parameters"),
    (after("initial: {x'': 1}\n"), "9:11", "acceleration"),
    (after("initial: {q: 1}\n"), "9:11", "not a coordinate"),
    (after("simulation: {until: m}\n"), "9:21", "only a number"),
    (after("simulation: {untill: 1}\n"), "9:14", "did you mean 'until'"),
    (after("expect: {degrees_of_freedom: 1.5}\n"), "9:30", "whole number"),
    (after("expect: {charges: {shfit: 1}}\n"), "9:20", "did you mean 'shift'"),
    (after("expect: {find: {heigt: 1}}\n"), "9:17", "did you mean 'height'"),
    (after("expect: {accelerations: {x: y''}}\n"), "9:29", "free of accelerations"),
    (after("expect: {hamiltonian: x'}\n"), "9:23", "momenta"),
    (after("expect: {equations: x = y}\n"), "9:21", "must be a list"),
    (GOOD.replace("g: 9.81", "g: r"), "2:40", "only numbers and parameters"),
    (GOOD.replace("d: x' + y", "d: t^2") + "expect: {modes: [d]}\n", "9:18", "contains the time"),
    (GOOD.replace("line: x + y", "line: m = 1"), "6:21", "no coordinate"),
    (GOOD.replace("line: x + y", "line: x == y"), "6:24", "write x = y"),
    (GOOD.replace("y: -1", "z: -1"), "7:28", "not a coordinate"),
    (GOOD.replace("for: x", "for: x''"), "8:37", "the acceleration"),
    (GOOD.replace(", for: x", ""), "8:8", "no 'for'"),
    (GOOD.replace("d: x' + y", "d: e + y, e: x"), "4:38", "defined later"),
    (GOOD.replace("d: x' + y", "d: d + y"), "4:38", "uses itself"),
    (GOOD.replace("U: [r]", "U: r"), "3:16", "write [r]"),
]


def test_the_good_file_is_good():
    assert read_problem("good.yaml", GOOD.encode()).diagnostics == ()


@pytest.mark.parametrize(("text", "place", "piece"), FILES)
def test_a_mistake_is_named_with_its_place(text, place, piece):
    reading = read_problem("bad.yaml", text.encode())
    assert reading.problem is None
    shown = render(reading.source, reading.diagnostics)
    lines = shown.splitlines()
    found = [
        place_line + "\n" + "\n".join(lines[i + 1 : i + 3])
        for i, place_line in enumerate(lines)
        if place_line.startswith(f"bad.yaml:{place}:")
    ]
    assert any(piece in one for one in found), shown


def test_all_mistakes_come_at_once_in_the_order_of_the_file():
    text = after("V: a*b\nforces: {x: 2 y, z: 1}\nexpect: {modes: [q]}\n")
    found = read_problem("bad.yaml", text.encode()).diagnostics
    places = [(one.span.line, one.span.column) for one in found]
    assert places == [(9, 4), (10, 13), (10, 18)]


def test_bytes_that_are_no_utf8_have_a_place():
    reading = read_problem("bad.yaml", b"coordinates: [x]\nT: \xe9\n")
    (mistake,) = reading.diagnostics
    assert (mistake.span.line, mistake.span.column) == (2, 4)
    assert "0xe9 is not UTF-8" in mistake.message


def test_utf16_is_named():
    (mistake,) = read_problem("bad.yaml", GOOD.encode("utf-16")).diagnostics
    assert "UTF-16" in mistake.message


@pytest.mark.parametrize("name", ["line feed", "carriage return", "both", "byte-order mark"])
def test_line_ends_and_byte_order_mark_change_no_place(name):
    text = after("V: tetha\n")
    data = {
        "line feed": text.encode(),
        "carriage return": text.replace("\n", "\r").encode(),
        "both": text.replace("\n", "\r\n").encode(),
        "byte-order mark": b"\xef\xbb\xbf" + text.encode(),
    }[name]
    (mistake,) = read_problem("bad.yaml", data).diagnostics
    assert (mistake.span.line, mistake.span.column) == (9, 4)


def test_an_assumption_in_the_place_of_a_value_is_told_how_it_is_written():
    text = b"coordinates: [x]\nparameters: {m: positive, k: real}\nT: m*x'^2/2\nV: k*x\n"
    (mistake,) = read_problem("f.yaml", text).diagnostics
    assert (mistake.span.line, mistake.span.column) == (2, 14)
    assert mistake.hint == "write m: {assume: positive}; write k: {assume: real}"


def test_letters_that_nothing_declares_are_one_mistake():
    text = b"coordinates: [x]\nT: m*x'^2/2\nV: k*x^2/2 + m*g*x + q*cos(y)\n"
    (mistake,) = read_problem("f.yaml", text).diagnostics
    assert mistake.message == "unknown names m, k, g, q, y: the first stands in T"
    assert (mistake.span.line, mistake.span.column) == (2, 4)
    assert mistake.hint == "declare them: parameters: [m, k, g, q, y]"


def test_a_letter_that_is_missing_is_one_mistake_wherever_it_stands():
    text = b"coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\nV: k*x^2/2 + k*x + g*x\n"
    found = read_problem("f.yaml", text).diagnostics
    assert [one.message for one in found] == ["unknown names k, g: the first stands in V"]


@pytest.mark.parametrize(
    "written",
    [
        "coordinates: [[x]]\nparameters_of_it: {m: 1}\nT: m*x'^2/2\n",
        "coordinates: [x, {y: 1}]\nparameters_of_it: {m: 1}\nT: m*x'^2/2\n",
        "coordinates: [x]\nparameters: {_: 1, m: 2}\nT: mq*x'^2/2 + mk\n",
        "coordinates:\\theta_{2 [x]\npara)meters: {m: 1}\nT: (m*omega1^2)/2\n",
    ],
)
def test_names_that_are_lists_and_the_name_of_one_underscore_are_mistakes_alone(written):
    assert any(each.is_error for each in read_problem("f.yaml", written.encode()).diagnostics)


@pytest.mark.parametrize("entry", ["\tm: 1", "\tm:\n\t\tvalue: 1", "\tm:\t1\n\tl: {value:\t2}"])
def test_tabs_do_not_hide_other_mistakes(entry):
    written = f"coordinates: [x]\nparameters:\n{entry}\nT: m*x'^2/2\nV: m*x*unknown\n"
    first, other = read_problem("p.yaml", written.encode()).diagnostics
    assert (first.message, first.span.line) == ("a tab cannot indent", 3)
    assert "'unknown'" in other.message
    line = written.split("\n")[other.span.line - 1]
    assert line[other.span.column - 1 :] == "unknown"


@pytest.mark.parametrize("entries", ["\tm: 1\n  k: 2", "  m: 1\n\tk: 2"])
def test_tabs_beside_blanks_are_one_mistake(entries):
    written = f"coordinates: [x]\nparameters:\n{entries}\nT: m*x'^2/2\n"
    [only] = read_problem("p.yaml", written.encode()).diagnostics
    assert only.message == "a tab cannot indent"


NAMED = [
    ("parameters", "m", ["unit: kg", "assume: positive"]),
    ("parameters", "m", ["value: 2", "description: the mass"]),
    ("coordinates", "x", ["unit: m", "symbol: X"]),
    ("points", "bob", ["position: [x, 0]", "mass: m"]),
    ("constraints", "rod", ["equation: x = m", "multiplier: N"]),
    ("contacts", "floor", ["gap: x >= 0", "restitution: 1"]),
]


@pytest.mark.parametrize(("section", "name", "attributes"), NAMED)
@pytest.mark.parametrize("count", [1, 2])
def test_attributes_that_begin_where_their_name_does_are_one_mistake(
    section, name, attributes, count
):
    begin = {"coordinates": "coordinates: [x]\n", "parameters": "parameters: [m]\n"}
    begin.pop(section, None)
    begin["T"] = "" if section == "points" else "T: m*x'^2/2\n"
    head = f"{''.join(begin.values())}{section}:\n  {name}:\n"
    line = head.count("\n") + 1
    given = attributes[:count]
    wrong = head + "".join(f"  {each}\n" for each in given)
    right = head + "".join(f"    {each}\n" for each in given)
    found = read_problem("p.yaml", wrong.encode()).diagnostics
    hints = [each.hint for each in found if each.message.endswith("not in it")]
    also = f", also in line {line + 1}" * (count > 1)
    assert hints == [f"begin the line with more blanks{also}"]
    assert len(found) == 1 + len(read_problem("p.yaml", right.encode()).diagnostics)


@pytest.mark.parametrize("brace", ["\n  {}\n  {}\n  {}", " {{{}, {}, {}}}"])
@pytest.mark.parametrize(
    ("name", "attributes", "whole"),
    [
        ("m: 2", ("unit: kg", "assume: positive"), "m: {value: 2, unit: kg, assume: positive}"),
        ("m: {value: 2}", ("unit: kg", "symbol: M"), "m: {value: 2, unit: kg, symbol: M}"),
        (
            "m: 2",
            ("assume: {assume: positive}", "unit: g"),
            "m: {value: 2, assume: positive, unit: g}",
        ),
    ],
)
def test_attributes_beside_a_name_that_has_a_value_are_one_mistake(brace, name, attributes, whole):
    def read(parameters):
        written = f"coordinates: [x]\nparameters:{parameters}\nT: m*x'^2/2\n"
        return read_problem("p.yaml", written.encode())

    [found] = read(brace.format(name, *attributes)).diagnostics
    assert found.hint == f"write all as {whole}"
    assert read(f" {{{whole}}}").checked()
