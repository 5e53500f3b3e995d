"""Hints with the file's own names and numbers, which lead to the problem that was meant."""

from __future__ import annotations

import pytest

from lagcli.reader import read_problem
from tests.reader.test_foreign_shapes import mistakes_of, only_mistake
from tests.reader.test_habits import text

PLANE = {"coordinates": "[x, y]", "T": "m*(x'^2 + y'^2)/2"}
OF_TIME = {"V": "U(x, t)*W(t)"}
ANGLE = {"coordinates": "[theta]", "T": "m*theta'^2/2", "V": "k*cos(theta)"}
TURNING = {"coordinates": "[x, theta]"}
ROLLING = {"coordinates": "[x, theta]", "T": "m*(x'^2 + R^2*theta'^2)/2", "parameters": "[m, k, R]"}
UNITS = {"coordinates": "{x: {unit: m}}", "V": "m*g*x", "initial": "{x: 1}"}
PAIR = {"observables": "{A_x: x*p_x, B: p_x}"}

HINTS = [
    (text(**PLANE, constraints="{at: x = k}", find="{turn: y' = 0}"), "{where: y' = 0, for: y}"),
    (text(**PLANE, constraints="{at: x - k = 0}", find="{a: {where: m*g = 0}}"), "for: y}"),
    (text(**PLANE, constraints="{at: x = y}", find="{a: {where: m*g = 0}}"), "for: x}"),
    (text(constraints="\n  rod: Eq(x^2, atan2(k, m))"), "write x^2 = atan2(k, m)"),
    (text(constraints="\n  rod: sp.Eq(x - k, 0)"), "write x - k = 0"),
    (text(constraints="\n  rod: Equal[x, k]"), "write x = k"),
    (text(constraints="\n  - Eq(x, k)"), "write {name: x = k}"),
    (text(constraints="\n  rod: Eq(x)"), "write left = right"),
    (text(constraints="{rod: f(x, k)}"), 'write "f(x, k)"'),
    (text(find="\n  turn: Eq(x', 0)"), "write {where: x' = 0, for: x}"),
    (text(T="Eq(T, m*x'^2/2)"), "write m*x'^2/2"),
    (text(coordinates="{x: {unit: m, start: 0.05}}"), "write initial: {x: 0.05}"),
    (text(coordinates="{x: {initial: [1, 0]}}"), "write initial: {x: 1, x': 0}"),
    (text(coordinates="{x: {velocity: 2}}"), "write initial: {x': 2}"),
    (text(coordinates="{x: {value: 0.5}}"), "write initial: {x: 0.5}"),
    (text(coordinates="{x: 0.5}"), "as in initial: {x: 0.5}"),
    (text(functions="\n  U(x, t):\n  W: [t]", **OF_TIME), "write U: [x, t]"),
    (text(functions="\n  - U(x, t)\n  - W(t)", **OF_TIME), "write {U: [x, t], W: [t]}"),
    (text(functions="U(x, t); W(t)", **OF_TIME), "write {U: [x, t], W: [t]}"),
    (text(functions="\n  U(x): 5", V="U"), "under definitions: write definitions: {U: 5}"),
    *[(text(**PAIR, brackets=f"\n  b: {pair}"), "write [A_x, B]")
      for pair in ("'{A_x, B}'", "{A_x, B}", "A_x, B", "(A_x, B)", r"\{A_x, B\}",
                   "'{A_x, B}_{PB} = 1'")],
    (text(symmetries=r"{s: {\delta x: 1}}"), "write x, whose change it is"),
    (text(symmetries="{s: {Delta x: 1}}"), "write x, whose change it is"),
    (text(simulation="{stopTime: 5}"), "the key is until"),
    (text(simulation="{startTime: 0}"), "leave it out"),
    (text(initialConditions="{x: 1}"), "the key is initial"),
    (text(simulation="{until: 5, method: ode45}"), "write dop853"),
    (text(simulation="{until: 5, method: ode15s}"), "write radau5"),
    (text(simulation="{until: 5, method: Verlet}"), "write gauss8"),
    (text(parameters="\n  - m\n  - k\n  - G M = 4"), "write {m, k, GM: 4}"),
    (text(parameters="\n  - m = 1\n  - G*M = 4\n  - k = 2"), "write {m: 1, GM: 4, k: 2}"),
    (text(**PLANE, initial="{x: 1, speed: 3, angle: 30°}"),
     "write {x: 1, x': 3*cos(30*pi/180), y': 3*sin(30*pi/180)}"),
    *[(text(**PLANE, initial=f"{{x: 1, v0: 10{unit}, {key}: {angle}}}"),
       f"write {{x: 1, x': 10*cos({radians}), y': 10*sin({radians})}}")
      for unit, key, angle, radians in (
          ("", "angle", "45", "45*pi/180"), (" m/s", "launch angle", "-30", "-30*pi/180"),
          ("", "alpha", "0.7", "0.7"), ("", "theta", "pi/4", "pi/4"),
          ("", "angle_deg", "45", "45*pi/180"), ("", "phi", "{value: 45, unit: deg}", "45*pi/180"))],
    *[(text(**ANGLE, initial=f"{{angle: {angle}}}"), f"write theta: {radians}")
      for angle, radians in (("45", "45*pi/180"), ("45°", "45*pi/180"), ("3", "3"))],
    *[(text(functions=f"{{U: {given}}}", V="U(x)"), "write [x]")
      for given in ("U(x)", "x", "f(x)", "(x)", "{x}", "'U(x)'")],
    (text(functions="{U: [U(x)]}", V="U(x)"), "write x"),
    (text(functions="{U: U(x, t)}", V="U(x, t)"), "write [x, t]"),
    (text(**PLANE, functions="{U: [x]}", V="U(x, y)"), "write U(x), or functions: {U: [x, y]}"),
    (text(**PLANE, functions="{U: [a, b]}", V="U(x)"), "write functions: {U: [x]}"),
    (text(functions="{U: [x, t]}", V="U"), "write U(x, t)"),
    (text(V="sin(x, k)"), "write sin(x)"),
    *[(text(**TURNING, T=f"m*(x'^2 + 2*x'*{omega}*cos(theta) + {omega}^2)/2"),
       "write m*(x'^2 + 2*x'*theta'*cos(theta) + theta'^2)/2") for omega in ("omega", "ω", "w", "Omega")],
    *[(text(**TURNING, T=T, V=V), "or its formula under 'definitions'")
      for T, V in (("m*(x'^2 + theta'^2 + omega^2*sin(theta)^2)/2", "k*x"),
                   ("m*(x'^2 + omega^2*x^2)/2 + m*omega", "k*x*omega"))],
    *[(text(find=f"{{turn: {{where: x' = 0, for: {unknown}}}}}"), "write x")
      for unknown in ("x_max", "xmax", "max(x)", "maximum of x", "x_turn", "height", "x0")],
    *[(text(parameters="{mass: 1, length: 2, kappa: 3, k: 1}", T="mass*x'^2/2", V=f"k*{name}*x"), hint)
      for name, hint in (("l", "did you mean 'length'?"), ("L", "did you mean 'length'?"),
                         ("m", "did you mean 'mass'?"), ("M", "or its formula under 'definitions'"))],
    *[(text(parameters=f"{{m: {value}, k: 2}}"), "write 0.5")
      for value in ("0.5 ± 0.01", "0.5±0.01", "0.5 +/- 0.01", "(0.5 ± 0.01)", "0.5 ± 2%")],
    (text(simulation="{until: 10, samples: 250}"), "lagcli simulate p.yaml --samples 250"),
    *[(text(**ROLLING, constraints=f"{{rolling: {words}}}"), "write x' = R*theta'")
      for words in ("true", "yes", "no slipping")],
    (text(**ROLLING, constraints="{rolling: }"), "write rolling: x' = R*theta'"),
    *[(text(**PLANE, contacts=f"{{{name}: {words}}}"), f"write {place}: {{gap: y >= 0}}")
      for name, words, place in (("ball", "floor", "floor"), ("floor", "true", "floor"),
                                 ("floor", "", "floor"), ("ball", "ground", "ground"))],
    (text(**PLANE, contacts="{wall: true}"), "write wall: {gap: x >= 0}"),
    (text(initial="{angle: 0.5}"), "known are x and velocities: x'"),
    (text(T="m*|x'|^2/2"), "write m*x'^2/2"),
    (text(T="m*|x' - k|²/2 + k*|x'|^3"), "write m*(x' - k)^2/2 + k*abs(x')^3"),
    (text(multipliers="{c: m*g}", constraints="{c: x = 1}"),
     "write expect: {multipliers: {c: m*g}}"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), HINTS)
def test_a_hint_has_the_names_and_numbers_of_the_file(written, hint):
    assert only_mistake(written).hint.endswith(hint)


@pytest.mark.parametrize(
    ("value", "unit", "converted"),
    [("981", "cm/s^2", ("m/s^2", 9.81)), ("-2", "km/s^2", ("m/s^2", -2000)),
     ("5", "mm/s^2", ("m/s^2", 0.005))],
)  # fmt: skip
def test_a_value_is_converted_with_its_unit(value, unit, converted):
    given = f"{{m: {{unit: kg, value: 1}}, g: {{unit: {unit}, value: {value}}}}}"
    mistake = only_mistake(text(**UNITS, parameters=given))
    assert mistake.hint == "write unit: {}, value: {:g}".format(*converted)


def test_a_value_is_converted_once_where_its_unit_has_several_mistakes():
    given = "{m: {unit: g, value: 3}, k: {unit: N/cm, value: 5}}"
    hints = {each.hint for each in mistakes_of(text(**UNITS | {"V": "k*x^2"}, parameters=given))}
    assert hints == {"write unit: g/s^2, value: 500000"}  # 500 N/m = 500 kg/s^2


def test_a_value_without_a_number_has_no_converted_one():
    given = "{m: {unit: kg, value: 1}, g: {unit: cm/s^2, value: 9*2}}"
    assert "value" not in only_mistake(text(**UNITS, parameters=given)).hint


@pytest.mark.parametrize("name", [r"\varphi", "x-cart", "x.1"])
def test_a_name_that_is_none_is_shown_where_it_is_used_too(name):
    written = f"coordinates:\n  - {name}\nparameters: [m]\nT: m*{name}'^2/2\nV: m*{name}\n"
    mistakes = mistakes_of(written)
    assert [each.span.line for each in mistakes] == [2]
    assert [span.line for span, _ in mistakes[0].related] == [4, 5]


def test_a_state_in_a_coordinate_is_that_of_the_file_where_it_is_put():
    written = text(coordinates="\n  x: {unit: m, start: 0.05}")
    mended = written.replace(", start: 0.05", "") + "initial: {x: 0.05}\n"
    assert only_mistake(written).hint.endswith("initial: {x: 0.05}")
    assert read_problem("p", mended.encode()).diagnostics == ()


@pytest.mark.parametrize(
    ("T", "count"),
    [("m*(x'^2 - x^2*theta'^2)/2", 1), ("k*x'^2 + m*(-x^2*theta'^2 + x'^2)/2", 1),
     ("m*(x'^2 + x^2*theta'^2)/2", 0), ("m*(x'^2 - k^2*theta'^2)/2", 0),
     ("m*(theta'^2 - theta^2*x'^2)/2", 0)],
)  # fmt: skip
def test_a_negative_square_in_polar_coordinates_is_a_warning(T, count):
    found = mistakes_of(text(coordinates="[x, theta]", T=T))
    assert [each.severity for each in found] == ["warning"] * count
