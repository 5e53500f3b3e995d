"""What stands under constraints and is none, or none yet: the hint has what is meant."""

import math
import random
import re

import pytest

from lagcli.reader import read_problem

FILE = (
    "coordinates: [x, y, phi]\nparameters: [m, a, l]\nT: m*(x'^2 + y'^2 + phi'^2)/2\n"
    "constraints: {{c: {}}}\n"
)


def only_hint(constraint):
    [only] = read_problem("p.yaml", FILE.format(constraint).encode()).diagnostics
    return only.hint


@pytest.mark.parametrize(
    ("quotient", "whole"),
    [
        ("y'/x' = tan(phi)", "y' = x'*tan(phi)"),
        ("tan(phi) - y'/x'", "x'*tan(phi) - y' = 0"),
        ("y'/x' = a - tan(phi)", "y' = x'*a - x'*tan(phi)"),
        ("(y' - a)/(x' + a) = phi", "(y' - a) = (x' + a)*phi"),
        ("a*y'/x'*l = phi", "a*y'*l = x'*phi"),
        ("y'/x' - l*phi'/x' = 2", "y' - l*phi' = x'*2"),
        ("phi = atan(y'/x')", "y' = x'*tan(phi)"),
        ("atan2(y', x') = phi + a", "y' = x'*tan(phi + a)"),
        (r"\frac{dy}{dx} = \tan\phi", "y' = x'*tan(phi)"),
    ],
)
def test_a_quotient_of_velocities_is_multiplied_out(quotient, whole):
    assert only_hint(f"'{quotient.replace(chr(39), chr(39) * 2)}'") == f"write {whole}"


@pytest.mark.parametrize(
    ("written", "contacts"),
    [
        ("y >= 0", "{c: y >= 0}"),
        ("y > a", "{c: y >= a}"),
        ("{equation: y ≥ 0, restitution: 0.8}", "{c: {gap: y >= 0, restitution: 0.8}}"),
        ("{equation: y >= 0, multiplier: N, holds_while: N >= 0}", "{c: {gap: y >= 0, multiplier: N}}"),
        ("0 <= x <= l", "{lower: x >= 0, upper: x <= l}"),
        ("'|x| < l'", "{lower: x >= -l, upper: x <= l}"),
        ("abs(x - a) <= l", "{lower: x - a >= -l, upper: x - a <= l}"),
    ],
)  # fmt: skip
def test_an_inequality_is_a_contact(written, contacts):
    assert only_hint(written) == f"in place of constraints write contacts: {contacts}"
    right = FILE.format("").replace("constraints: {c: }", f"contacts: {contacts}")
    assert read_problem("p.yaml", right.encode()).diagnostics == ()


AMONG = [
    ("{c: x = a, d: y >= 0}", "", "leave it out", "{c: x = a}", "d: y >= 0"),
    ("{c: x = a, d: y >= 0, e: x <= l}", "", "leave them out", "{c: x = a}", "d: y >= 0, e: x <= l"),
    ("{c: x >= a, d: y >= 0}", "", "in place of constraints", "", "c: x >= a, d: y >= 0"),
    ("{c: -l <= x <= l, d: 0 < y < a}", "", "in place of constraints", "",
     "lower: x >= -l, upper: x <= l, d_1: y >= 0, d_2: y <= a"),
    ("[x = a, y >= 0]", "", "write {c1: x = a}", "{c1: x = a}", "floor: y >= 0"),
    ("x = a, y >= 0", "", "write {c1: x = a}", "{c1: x = a}", "floor: y >= 0"),
    ("y >= 0", "", "in place of constraints", "", "floor: y >= 0"),
    ("{c: 'x = a, y >= 0'}", "", "write c: x = a", "{c: x = a}", "c_2: y >= 0"),
    ("{d: y >= 0}", "e: x <= l", "leave constraints out", "", "d: y >= 0"),
    ("{c: x = a, d: y >= 0}", "e: x <= l", "leave it out", "{c: x = a}", "d: y >= 0"),
    ("{c: x = a, d: y >= 0, f: x >= 0}", "e: x <= l", "leave them out", "{c: x = a}",
     "d: y >= 0, f: x >= 0"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "given", "begin", "left", "contacts"), AMONG)
def test_inequalities_are_moved_at_once_and_leave_no_empty_section(
    written, given, begin, left, contacts
):
    head = FILE.partition("constraints")[0]
    section = f"contacts: {{{given}}}\n" * bool(given)
    [only] = read_problem("p.yaml", f"{head}{section}constraints: {written}\n".encode()).diagnostics
    hint = only.hint
    if given:
        assert hint == f"{begin}, and begin contacts with {contacts.replace(', ', ' and ')}"
    else:
        rest = "" if begin.startswith("in place") else ", and on a line of its own"
        assert hint == f"{begin}{rest} write contacts: {{{contacts}}}"
    right = f"contacts: {{{contacts}{f', {given}' * bool(given)}}}\n"
    right += f"constraints: {left}\n" * bool(left)
    assert read_problem("p.yaml", (head + right).encode()).diagnostics == ()


def test_an_inequality_among_constraints_hides_no_other_mistake():
    energies = "T: m*(x'^2 + y'^2)/2\nV: k*x\nconstraints: {c: x >= 0, d: y >= 0}\n"
    units = (
        "coordinates: {x: {unit: m}, y: {unit: m}}\nparameters: {m: {unit: kg}, k: {unit: N/m}}\n"
    )
    found = read_problem("p.yaml", f"{units}{energies}".encode()).diagnostics
    assert [each.span.line for each in found] == [4, 5]


SECTIONS = "constraints contacts forces symmetries initial find simulation points functions"


@pytest.mark.parametrize("section", [*SECTIONS.split(), "definitions", "observables", "brackets"])
def test_a_section_without_entries_is_left_out(section):
    good = FILE.partition("constraints")[0]
    [only] = read_problem("p.yaml", f"{good}{section}:\n".encode()).diagnostics
    assert only.hint == "leave out the key"


@pytest.mark.parametrize("between", [" and ", "; ", ";"])
@pytest.mark.parametrize("form", ["'{}'", "{{equation: '{}'}}"])
def test_equations_of_one_name_get_one_each(between, form):
    hint = only_hint(form.format(f"x = a{between}y = 0"))
    assert hint == "each equation has its own name: c_1: x = a, c_2: y = 0"


BODIES = """coordinates: [x, phi]
parameters: {{m: 1, l: 2, k: 3}}
points:
  A: {{position: [x, 0], mass: m}}
  B: {{position: [x + l*sin(phi), -l*cos(phi)*exp(k*x)], mass: m}}
V: m*x
constraints:
  c: {}
"""


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("B.x' = 1", lambda v: v[1][0]),
        ("B'.y = 1", lambda v: v[1][1]),
        ("A.x' = 1", lambda v: v[0][0]),
        ("|B'|^2 = 1", lambda v: v[1][0] ** 2 + v[1][1] ** 2),
        ("|B' - A'|^2 = 1", lambda v: (v[1][0] - v[0][0]) ** 2 + v[1][1] ** 2),
        ("norm(B') = 1", lambda v: math.hypot(*v[1])),
    ],
)
def test_the_velocity_of_a_point_is_the_rate_of_its_position(written, meant):
    [hint] = [
        each.hint for each in read_problem("p.yaml", BODIES.format(written).encode()).diagnostics
    ]
    formula = hint.removeprefix("write ").removeprefix("c: ").removesuffix(" = 1")
    x, phi, dx, dphi, h = 0.3, 0.7, -0.4, 1.1, 1e-6

    def places(at):
        q, angle = x + dx * at, phi + dphi * at
        return (q, 0.0), (q + 2 * math.sin(angle), -2 * math.cos(angle) * math.exp(3 * q))

    rates = [[(b - a) / (2 * h) for a, b in zip(*each, strict=True)]
             for each in zip(places(-h), places(h), strict=True)]  # fmt: skip
    code = re.sub(r"\b(x|phi)'", r"d\1", formula).replace("^", "**")
    known = {name: getattr(math, name) for name in ("sin", "cos", "exp", "sqrt")}
    found = eval(code, known | {"x": x, "phi": phi, "dx": dx, "dphi": dphi, "l": 2, "k": 3})
    assert found == pytest.approx(meant(rates), rel=1e-6)


ROLLING = """coordinates: [x, y, phi, theta]
parameters: [m, R, I]
T: m*(x'^2 + y'^2)/2 + I*phi'^2/2 + I*theta'^2/2
constraints:
  c: {}
  heading: {}
"""


@pytest.mark.parametrize(
    "square", ["x'^2 + y'^2 = R^2*phi'^2", "(R*phi')^2 - x'^2 - y'^2", "sqrt(x'^2 + y'^2) = R*phi'"]
)
@pytest.mark.parametrize(
    ("heading", "along"),
    [
        ("y'*cos(theta) = x'*sin(theta)", lambda a: (math.cos(a), math.sin(a))),
        ("x'*cos(theta) + y'*sin(theta)", lambda a: (-math.sin(a), math.cos(a))),
        ("x'*cos(theta) - y'*sin(theta)", lambda a: (math.sin(a), math.cos(a))),
    ],
)
def test_the_square_of_a_speed_is_two_constraints_along_the_heading(square, heading, along):
    [found] = read_problem("p.yaml", ROLLING.format(square, heading).encode()).diagnostics
    given = re.search(
        r": c_1: x' = (.*), and on a line of its own c_2: y' = (.*)$", found.hint
    ).groups()
    python = [each.replace("phi'", "w") for each in given]
    names = {"R": 2, "w": 3, "theta": 0.4, "cos": math.cos, "sin": math.sin}
    for formula, size in zip(python, along(0.4), strict=True):
        assert math.isclose(eval(formula, {}, names), 6 * size)
    right = ROLLING.format(f"{given[0]} - x'", heading) + f"  d: y' = {given[1]}\n"
    assert read_problem("p.yaml", right.encode()).diagnostics == ()


@pytest.mark.parametrize("seed", range(12))
def test_a_multiplier_in_an_energy_is_a_constraint(seed):
    draw = random.Random(seed)
    name = draw.choice(["lambda", "lam", "λ", "mu", "lambda_1", "Lambda"])
    left, right = draw.choice([("x^2 + y^2", "l^2"), ("y", "x*tan(a)"), ("x'", "l*a*y'")])
    sign = draw.choice("+-")
    law = f"({left} - {right})"
    term = draw.choice([f"{name}*{law}", f"{law}*{name}", f"{name}*{law}/2", f"2*{name}*{law}"])
    begin = "coordinates: [x, y]\nparameters: [m, g, l, a]\n"
    L, others = draw.choice([
        ("L: m*(x'^2 + y'^2)/2 - m*g*y", ""), ("V: m*g*y", "T: m*(x'^2 + y'^2)/2\n"),
    ])  # fmt: skip
    [found] = read_problem("p.yaml", f"{begin}{others}{L} {sign} {term}\n".encode()).diagnostics
    meant = found.hint.removeprefix("write ").split(", and on a line of its own ")
    assert meant == [L[3:], f"constraints: {{c1: {left} = {right}}}"]
    right = f"{begin}{others}{L[:3]}{meant[0]}\n{meant[1]}\n"
    assert read_problem("p.yaml", right.encode()).problem


@pytest.mark.parametrize("term", ["mu*x^2", "lambda*x^4/4", "lambda*(x^2 - l^2)^2", "mu/(x - l)"])
def test_a_coupling_is_no_multiplier(term):
    begin = "coordinates: [x]\nparameters: [m, l]\n"
    [found] = read_problem("p.yaml", f"{begin}L: m*x'^2/2 - {term}\n".encode()).diagnostics
    assert found.message.startswith("unknown name")


@pytest.mark.parametrize("seed", range(12))
def test_a_coordinate_as_the_name_of_a_constraint_is_its_left_side(seed):
    """`y: -x*tan(a)` would mean -x*tan(a) = 0, where the incline y = -x*tan(a) is meant."""
    draw = random.Random(seed)
    section, sign = draw.choice([("constraints", "="), ("contacts", ">=")])
    first = "equation" if section == "constraints" else "gap"
    prime = draw.choice(["", "'"]) if section == "constraints" else ""
    law = draw.choice([f"a*x{prime}", "l", "0", "a*sin(t)", f"l - x{prime}", f"-x{prime}*tan(a)"])
    written, right = law, f"y{prime} {sign} {law}"
    if draw.random() < 0.4:
        written, right = (f"{{{first}: {each}, multiplier: N}}" for each in (law, right))
    whole = f"{FILE.partition('constraints')[0]}{section}: {{y{prime}: {written}}}\n"
    if "x'" in law and draw.random() < 0.5:  # y: a*x'
        whole = whole.replace("y':", "y:")
    [found] = read_problem("p.yaml", whole.encode()).diagnostics
    assert (found.message.split("'", 1)[0], found.hint) == ("the name ", f"write y: {right}")
    pasted = re.sub(r"\{y'?: .*", f"{{y: {right}}}", whole)
    assert read_problem("p.yaml", pasted.encode()).diagnostics == ()


@pytest.mark.parametrize("form", ["{{{}}}", "\n  {}", "{{h: R, {}}}"])
@pytest.mark.parametrize(
    ("x", "law"), [("x", "R*phi"), ("phi", "x/R"), ("x", "R*(phi - a)"), ("phi", "w*t")]
)
def test_a_definition_of_a_coordinate_is_a_constraint(x, law, form):
    """Under another name it would be accepted, and the rolling lost without a word."""
    begin = "coordinates: [x, phi]\nparameters: [m, R, a, w]\n"
    energy = "T: m*x'^2/2 + m*R^2*phi'^2/4\n"
    definitions = f"definitions: {form.format(f'{x}: {law}')}\n"
    [found] = read_problem("p.yaml", f"{begin}{definitions}{energy}".encode()).diagnostics
    right = f"constraints: {{{x}: {x} = {law}}}"
    assert found.hint == f"a relation of coordinates: write {right}"
    assert read_problem("p.yaml", f"{begin}{right}\n{energy}".encode()).diagnostics == ()


@pytest.mark.parametrize(
    "written", ["y: y - a*x", "y: y - l", "floor: y - l", "y: x = y", "v: a*x"]
)
def test_a_constraint_without_equals_sign_is_zero(written):
    text = f"{FILE.partition('constraints')[0]}constraints: {{{written}}}\n"
    assert read_problem("p.yaml", text.encode()).diagnostics == ()


@pytest.mark.parametrize("seed", range(8))
def test_an_inequality_beside_an_equation_is_holds_while(seed):
    draw = random.Random(seed)
    law = draw.choice(["N >= 0", "N > 0", "N < a", "y < l", "x >= y"])
    word = draw.choice(["condition", "holds", "valid", "if", "only_if", "range", "until", "when"])
    entries = ["equation: x = a", "multiplier: N", draw.choice([f"{word}: {law}", law])]
    rest = entries[1:]
    draw.shuffle(rest)
    whole = f"{{{', '.join([entries[0], *rest])}}}"
    hint = only_hint(whole)
    assert hint == ("the key is holds_while" if ":" in entries[2] else f"write holds_while: {law}")
    pasted = whole.replace(entries[2], f"holds_while: {law}")
    assert read_problem("p.yaml", FILE.format(pasted).encode()).diagnostics == ()


@pytest.mark.parametrize("law", ["N >= 0", "N < a", "-N > 0"])
def test_an_inequality_of_a_multiplier_is_the_condition_of_its_constraint(law):
    rod = "x = a, multiplier: N"
    [told] = read_problem(
        "p.yaml", FILE.format(f"{{equation: {rod}}}, d: {law}").encode()
    ).diagnostics
    whole = f"{{equation: {rod}, holds_while: {law}}}"
    assert told.hint == f"leave it out, and in line 4 write c: {whole}"
    assert read_problem("p.yaml", FILE.format(whole).encode()).diagnostics == ()


@pytest.mark.parametrize(
    ("left", "parameter", "warned"),
    [
        ("x + y", "L", "did you mean x + y = L?"),
        ("2*x + y", "d", "did you mean 2*x + y = d?"),
        ("x + y = 0", "L", None),
        ("x - a*y", "L", None),
        ("x + y", "g", None),
    ],
)
def test_a_rope_without_its_length_is_warned_of(left, parameter, warned):
    file = (
        f"coordinates: [x, y]\nparameters: [m, a, {parameter}]\nT: m*(x'^2 + y'^2)/2\nV: a*x\n"
        f"constraints: {{rope: {left}}}\n"
    )
    found = read_problem("p.yaml", file.encode()).diagnostics
    assert [each.hint for each in found] == ([warned] if warned else [])
    assert all(each.severity == "warning" for each in found)
