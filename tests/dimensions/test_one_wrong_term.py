"""One term with a wrong dimension: the hint has the term or the unit with which all of them fit."""

import random
import re

import pytest

from lagcli.reader import read_problem

SPRING = (
    "coordinates: [x]\nparameters: {{m: {{unit: kg}}, k: {{unit: {}}}, g: {{unit: m/s^2}}}}\n"
    "T: {}\nV: {}\n"
)


def errors(written):
    return [x for x in read_problem("p.yaml", written.encode()).diagnostics if x.is_error]


@pytest.mark.parametrize(
    ("unit", "kinetic", "potential", "wrong", "hint"),
    [("N", "m*x'^2/2", "k*x^2/2", "the unit of 'k'", "write N/m"),
     ("kg", "m*x'^2/2", "k*x^2/2 - m*g*x", "the unit of 'k'", "write N/m"),
     ("N/m", "m*x'^2/2", "k*x/2 - m*g*x", "'k*x/2'", "write k*x^2/2: "),
     ("N/m", "m*x'/2", "k*x^2/2 - m*g*x", "'m*x'/2'", "write m*x'^2/2: "),
     ("N/m", "x'^2/2", "k*x^2/2 - m*g*x", "'x'^2/2'", "write m*x'^2/2: "),
     ("N/m", "m*x'^2/2", "k*x^2/2 - m*x", "'m*x'", "write g*m*x: "),
     ("N/m", "m*x^2/2", "k*x^2/2", "'m*x^2/2'", "write m*x'^2/2: "),
     ("N/m", "m*x'^2/2", "k*x^2/2 - g*x", "'g*x'", "write m*g*x: ")],
)  # fmt: skip
def test_a_coordinate_without_a_unit_is_a_length(unit, kinetic, potential, wrong, hint):
    [only] = errors(SPRING.format(unit, kinetic, potential))
    assert only.message.startswith(wrong)
    assert only.hint.startswith(hint)


def test_a_coordinate_of_another_kind_is_found_by_the_terms():
    circuit = (
        "coordinates: [q]\nparameters: {{I: {{unit: H}}, C: {{unit: F}}, U: {{unit: V}}}}\n"
        "T: I*q'^2/2\nV: q^2/(2*C) - {}\n"
    )
    assert errors(circuit.format("q*U")) == []
    [only] = errors(circuit.format("q^2*U"))
    assert only.message.startswith("'q^2*U' is")
    assert only.hint.startswith("write q*U")


@pytest.mark.parametrize("seed", range(10))
def test_the_term_in_the_hint_is_put_in(seed):
    draw = random.Random(seed)
    length, m, angle = (
        draw.choice("lRa"),
        draw.choice(["m", "M", "m_1"]),
        draw.choice(["phi", "theta"]),
    )
    good = (
        f"coordinates: [{angle}]\n"
        f"parameters: {{{m}: {{unit: kg}}, {length}: {{unit: m}}, g: {{unit: m/s^2}}}}\n"
        f"T: {m}*{length}^2*{angle}'^2/2\nV: -{m}*g*{length}*cos({angle})\n"
    )
    assert errors(good) == []
    wrong = draw.choice([
        good.replace(f"{length}^2", length), good.replace(f"{length}^2", f"{length}^3"),
        good.replace(f"T: {m}*", "T: "), good.replace("*g*", "*"), good.replace(f"{angle}'^2", f"{angle}'"),
        good.replace(f"-{m}*g", f"-{m}^2*g"),
    ])  # fmt: skip
    [only] = errors(wrong)
    term = re.match(r"write (.+?): ", only.hint)
    assert term is not None, only
    lines = wrong.split("\n")
    line, span = lines[only.span.line - 1], only.span
    lines[span.line - 1] = line[: span.column - 1] + term[1] + line[span.end_column - 1 :]
    assert errors("\n".join(lines)) == []


@pytest.mark.parametrize("seed", range(10))
def test_a_half_of_a_sum_of_coordinates_lacks_its_square(seed):
    draw = random.Random(seed)
    x, y = draw.sample(["x", "y", "s", "x_1", "q2"], 2)
    sum_ = draw.choice([f"({y} - {x})", f"({x} + 2*{y} - a)", f"({x} - (a - {y}))"])
    half = draw.choice(["k*{}/2", "1/2*k*{}", "{}*k/2", "0.5*k*{}"])
    rate = draw.choice([f"({y}' - {x}')", f"({x}' + {y}')", f"({x}' - 2*({y}'))"])
    good = (
        f"coordinates: {{{x}: {{unit: m}}, {y}: {{unit: m}}}}\n"
        "parameters: {m: {unit: kg}, k: {unit: N/m}, a: {unit: m}, b: {unit: m}, c: {unit: kg/s}}\n"
        f"T: m*{x}'^2/2 + m*{y}'^2/2\nV: k*{x}^2/2 + {half.format(f'{sum_}^2')}\n"
        f"dissipation: c*{rate}^2/2 + c*{x}'^2/2\n"
    )
    assert errors(good) == []
    square = draw.choice([sum_, rate])
    [only] = errors(good.replace(f"{square}^2", square))
    term = only.hint.removeprefix("write ").partition(": ")[0]
    assert f"{square}^2" in term
    assert term in good


def test_terms_that_are_wrong_for_themselves_are_mended_one_by_one():
    written = (
        "coordinates: {x: {unit: m}, theta: {unit: rad}}\n"
        "parameters: {m: {unit: kg}, R: {unit: m}, g: {unit: m/s^2}, a: {unit: rad}}\n"
        "T: m*x'^2/2 + m*R*theta'^2/4\nV: -m*g*x*sin(a)\nconstraints: {rolling: x' = theta'}\n"
    )
    first, second = errors(written)
    assert first.hint.startswith("write m*R^2*theta'^2/4: ")
    assert second.hint.startswith("write R*theta': ")
    mended = written.replace("m*R*", "m*R^2*").replace("= theta'", "= R*theta'")
    assert errors(mended) == []


def test_no_factor_is_guessed_where_a_unit_may_be_wrong_as_well():
    written = (
        "coordinates: {phi: {unit: rad}}\n"
        "parameters: {I: {unit: kg*m}, m: {unit: kg}, g: {unit: m/s^2}, s: {unit: m},"
        " k: {unit: N/m}}\nT: I*phi'^2/2\nV: -m*g*s*cos(phi) + k*phi^2/2\n"
    )
    assert not [each.hint for each in errors(written) if "write" in each.hint]


WRONG_UNITS = [
    ("m*x'^2/2", "k*x^2/2 + m*g*x", {"m": "kg", "k": "N", "g": "m/s"}),
    ("m*x'^2/2", "k*x^2/2 + m*g*x", {"m": "N", "k": "N", "g": "m/s^2"}),
    ("m*l^2*theta'^2/2", "-m*g*l*cos(theta)", {"m": "kg", "l": "s", "g": "N"}),
    ("m*l^2*theta'^2/2", "-m*g*l*cos(theta)", {"m": "N", "l": "m^2", "g": "m/s^2"}),
]
USUAL = {"m": "kg", "k": "N/m", "g": "m/s^2", "l": "m"}


@pytest.mark.parametrize(("kinetic", "potential", "units"), WRONG_UNITS)
def test_each_of_several_wrong_units_is_named(kinetic, potential, units):
    coordinate = "theta: {unit: rad}" if "theta" in kinetic else "x: {unit: m}"
    given = ", ".join(f"{name}: {{unit: {unit}}}" for name, unit in units.items())
    found = errors(
        f"coordinates: {{{coordinate}}}\nparameters: {{{given}}}\nT: {kinetic}\nV: {potential}\n"
    )
    wrong = {name: USUAL[name] for name, unit in units.items() if USUAL[name] != unit}
    named = {each.message.split("'")[1]: each.hint.removeprefix("write ") for each in found}
    assert named == wrong


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize(
    ("wrong", "right"),
    [("{m}*g", "{m}*g*{x}"), ("2*{m}*g", "2*{m}*g*{x}"), ("{k}*{x}", "{k}*{x}^2/2"),
     ("{x}*{k}", "{x}^2*{k}/2"), ("{k}/2", "{k}*{x}^2/2"), ("-{m}*g", "{m}*g*{x}"),
     ("{m}*g*{x}^2", "{m}*g*{x}")],
)  # fmt: skip
def test_a_force_in_place_of_an_energy_is_told_its_potential(seed, wrong, right):
    draw = random.Random(seed)
    m, k, x = (draw.choice(names) for names in (["m", "M"], ["k", "k_1", "c"], "xyzs"))
    file = (
        f"coordinates: {{{x}: {{unit: m}}}}\nparameters: {{{m}: {{unit: kg}}, g: {{unit: m/s^2}}, "
        f"{k}: {{unit: N/m}}}}\nT: {m}*{x}'^2/2\nV: {k}*{x}^2/2 + "
    )
    [only] = errors(f"{file}{wrong.format(m=m, k=k, x=x)}\n".replace("+ -", "- "))
    assert only.hint.startswith(f"write {right.format(m=m, k=k, x=x)}: ")


def test_a_coordinate_is_added_to_constants_only_where_no_other_fits():
    file = (
        "coordinates: {x: {unit: m}, y: {unit: m}}\nparameters: {m: {unit: kg}, g: {unit: m/s^2}, "
        "l: {unit: m}}\nT: m*(x'^2 + y'^2)/2\nV: m*g*x - m*g\n"
    )
    [only] = errors(file)
    assert only.hint.startswith("a length (m) is missing")
    turning = (
        "coordinates: {phi: {unit: rad}}\nparameters: {m: {unit: kg}, g: {unit: m/s^2}, l: {unit: m}"
        "}\nT: m*phi'^2/2\nV: -m*g*l*cos(phi)\n"
    )
    [only] = errors(turning)
    assert only.hint.startswith("write l^2*m*phi'^2/2: ")
    [only] = errors(turning.replace("l: {unit: m}", "l: {unit: m}, R: {unit: m}"))
    assert only.hint.startswith("write l^2*m*phi'^2/2 or R^2*m*phi'^2/2: an area (m^2)")


LENGTHS = [
    ("m*g*cos(theta)", ""),
    ("sin(theta)*m*g", ""),
    ("k*a", "forces: {theta: -F*sin(theta)}"),
]


@pytest.mark.parametrize("lengths", [(), ("a",), ("a", "b")])
@pytest.mark.parametrize("r", ["r", "s", "x"])
@pytest.mark.parametrize(("term", "force"), LENGTHS)
def test_a_length_that_may_be_a_coordinate_is_not_taken_for_a_parameter(term, force, r, lengths):
    file = (
        f"coordinates: {{{r}: {{unit: m}}, theta: {{unit: rad}}}}\nparameters: {{m: {{unit: kg}}, "
        "g: {unit: m/s^2}, F: {unit: N}, k: {unit: N}"
        + "".join(
            f", {each}: {{unit: m}}" for each in {*lengths, *term.replace("k*", "")} & {*"ab"}
        )
        + f"}}\nT: m*({r}'^2 + {r}^2*theta'^2)/2\nV: m*g*{r} + {term}\n{force}\n"
    )
    [only] = errors(file)
    wrong = "F*sin(theta)" if force else term
    named = re.findall(rf"\b(\w)\*{re.escape(wrong)}", only.hint)
    fitting = [*sorted({*lengths, *term.replace("k*", "")} & {*"ab"}), r]
    assert sorted(named) == (sorted(fitting) if len(fitting) < 3 else [])
    for each in named:
        assert errors(file.replace(wrong, f"{each}*{wrong}")) == []


@pytest.mark.parametrize("others", ["", ", a: {unit: m}", ", a: {unit: m}, b: {unit: m}"])
@pytest.mark.parametrize("r", ["r", "s", "l"])
def test_a_power_of_what_the_term_has_comes_before_another_length(r, others):
    x, length = ("x", ", l: {unit: m}") if r == "l" else (r, "")
    [only] = errors(
        f"coordinates: {{{x}: {{unit: m}}, theta: {{unit: rad}}}}\n"
        f"parameters: {{m: {{unit: kg}}{length}{others}}}\nT: m*({x}'^2 + {r}*theta'^2)/2\n"
    )
    assert only.hint.startswith(f"write {r}^2*theta'^2: a length (m) is missing")


def test_a_factor_too_many_is_left_out_with_its_sign():
    file = (
        "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, F: {unit: N}}\n"
        "T: m*x'^2/2\nforces: {x: %s}\n"
    )
    for term in ("F*x", "x*F"):
        [only] = errors(file % term)
        assert only.hint.startswith("write F: ")


@pytest.mark.parametrize(
    ("force", "number", "unit"),
    [("F*sin(2*t)", "2", "1/s"), ("F*sign(t - 0.5)", "0.5", "s"), ("F*exp(-t)", "1", "1/s"),
     ("F*cos(3*x)", "3", "1/m"), ("F + 4", "4", "N")],
)  # fmt: skip
def test_a_number_that_lacks_a_unit_becomes_a_parameter_with_it(force, number, unit):
    begin = (
        "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, F: {unit: N}%s}\nT: m*x'^2/2\n"
    )
    [only] = errors(f"{begin % ''}forces: {{x: {force}}}\n")
    name, meant = re.fullmatch(
        r"declare (\w+): .* under parameters, and write (.*)", only.hint
    ).groups()
    assert f"{{unit: {unit}, value: {number}}}" in only.hint
    declared = f", {name}: {{unit: {unit}, value: {number}}}"
    written = force.replace(only.message.split("'")[1], meant)
    assert errors(f"{begin % declared}forces: {{x: {written}}}\n") == []


@pytest.mark.parametrize("arm", ["x", "(x - l)"])
@pytest.mark.parametrize("others", ["", "m*g*x "])
def test_the_force_of_a_spring_in_V_loses_its_minus(arm, others):
    sign = "- " if others else "-"
    file = SPRING.format("N/m", "m*x'^2/2", f"{others}<V>").replace("k:", "l: {unit: m}, k:")
    [only] = errors(file.replace("<V>", f"{sign}k*{arm}"))
    assert only.message.startswith(f"'-k*{arm}' is a force (N)")
    better = f"{'+ ' * bool(others)}k*{arm}^2/2"
    assert only.hint == f"write {better}: V is minus the integral of the force"
    line = file.replace("<V>", f"{sign}k*{arm}").split("\n")[only.span.line - 1]
    stretch = slice(only.span.column - 1, only.span.end_column - 1)
    assert line[stretch] == f"{sign}k*{arm}"
    assert errors(file.replace("<V>", better)) == []
