"""What beginners write from the habit of a book or another program: one mistake, one hint.

Each case is what is changed in a good file, and the hint that names what would be right.
"""

from __future__ import annotations

import random

import pytest

from lagcli.library import entries
from lagcli.reader import read_problem
from lagcli.reader.habits import habits, meanings
from lagcli.statements.registry import section_names

GOOD = {
    "coordinates": "[x]",
    "parameters": "{m: 1, k: 2, g: 9.81}",
    "T": "m*x'^2/2",
    "V": "k*x^2/2",
}


def text(**changed):
    parts = {key: value for key, value in (GOOD | changed).items() if value is not None}
    return "".join(f"{key}: {value}\n" for key, value in parts.items())


def messages(written):
    reading = read_problem("p.yaml", written.encode())
    return [f"{each.message}; {each.hint}" for each in reading.diagnostics]


HABITS = [
    (text(T="m*x'²/2"), "write m*x'^2/2"),
    (text(V="k*(x + 1)²/2"), "write k*(x + 1)^2/2"),
    (text(V="k*x³"), "write k*x^3"),
    (text(T="½*m*x'^2"), "write (1/2)*m*x'^2"),
    (text(V="¾*x"), "write (3/4)*x"),
    (text(parameters="{m: 1 kg, k: 2}"), "write {value: 1, unit: kg}"),
    (text(parameters="{m: 1, k: 2.5 N/m}"), "write {value: 2.5, unit: N/m}"),
    (text(parameters="{m: 1, k: 2, g: {value: 9.81 m/s^2}}"), "write value: 9.81, unit: m/s^2"),
    (text(initial="{x: 10 cm}"), "write 10"),
    (text(simulation="{until: 10 s}"), "write 10"),
    (text(T=None, V=None, H="p^2/(2*m)"), "write p_x^2/(2*m)"),
    (text(V=None, potential="k*x^2"), "the key is V"),
    (text(T=None, kinetic="m*x'^2"), "the key is T"),
    (text(T=None, V=None, lagrangian="m*x'^2"), "the key is L"),
    (text(V=None, **{"Potential energy": "k*x^2"}), "the key is V"),
    (text(damping="x'^2"), "the key is dissipation"),
    (text(parameters=None, T="x'^2", V=None, constants="[m]"), "the key is parameters"),
    (text(parameters="\n  m: 1\n  k: 9,81"), "write 9.81"),
    (text(initial="{x: 30°}"), "write 30*pi/180"),
    (text(T="m*Derivative(x, t)^2/2"), "write m*x'^2/2"),
    (text(T="m*diff(x, t)^2/2"), "write m*x'^2/2"),
    (text(T="m*diff(x^2, t)^2/2"), "a total time derivative is a prime"),
    (text(symmetries="{s: {shift: {x: 1}}}"), "write s: {x: 1}"),
    (text(T="m*x(t)'^2/2"), "write m*x'^2/2"),
    (text(V="k*x(t)^2"), "write k*x^2"),
    (text(T="m*pow(x', 2)/2"), "write m*x'^2/2"),
    (text(T="m*vx^2/2"), "write m*x'^2/2"),
    (text(T="m*xdot^2/2"), "write m*x'^2/2"),
    (text(T="m*ẋ^2/2"), "write m*x'^2/2"),
    (text(forces="F"), "write {x: F"),
    (text(coordinates="x"), "write [x]"),
    (text(coordinates="x, y", T="m*(x'^2 + y'^2)/2"), "write [x, y]"),
    (text(parameters="\n  m = 1\n  k = 2"), "write {m: 1, k: 2}"),
    (text(constraints="{floor: x > 0}"), "write contacts: {floor: x >= 0}"),
    (text(coordinates="[θ₁]", T="m*θ₁'^2/2", V="k*θ₁"), "write θ_1"),
    (text(coordinates="[\\theta]", T="m*\\theta'^2/2", V=None), "write theta"),
    (text(T="T = m*x'^2/2"), "write m*x'^2/2"),
    (text(V="k*sin^2(x)"), "write k*sin(x)^2"),
    (text(V="k*sin x"), "sin(x)"),
    (text(V="k*ln x"), "log(x)"),
    (text(V="arctan x"), "atan(x)"),
    (text(T="m*(d/dt x)^2/2"), "write m*x'^2/2"),
    (text(V="k*ln(x)"), "did you mean k*log(x)?"),
    (text(V="k*e^x"), "write k*exp(x)"),
    (text(V="k*|x|"), "write k*abs(x)"),
    (text(V="k*√x"), "write k*sqrt(x)"),
    (text(V="k x"), "did you mean k*x"),
    (text(V="2x"), "did you mean 2*x"),
    (text(V="k·x"), "write k*x"),
    (text(constraints="{a: x == 1}"), "write x = 1"),
    (text(constraints="[x = 1]"), "write {name: x = 1"),
    (text(initial="x = 1"), "write {x: 1"),
    (text(simulate="{until: 3}"), "the key is simulation"),
    (
        "coordinates: [x]\nparameters: [m]\n T: m*x'^2/2\n",
        "begin the line where 'parameters' begins",
    ),
    (text(V=None) + "  V: k*x^2/2\n", "begin the line where 'T' begins"),
    ("coordinates [x]\nT: x'^2/2\n", "write coordinates: [x]"),
    ("coordinates： [x]\nT: x'^2/2\n", "write coordinates: [x]"),
    ("coordinates = [x]\nT = x'^2/2\n", "write coordinates: [x]"),
    ("swing:\n  coordinates: [x]\n  T: x'^2/2\n", "its keys begin the lines"),
    ("coordinates:\nT: x'^2/2\n", "such as [x, y]"),
    ("Coordinates: [x]\nT: x'^2/2\n", "the key is coordinates"),
    ("variables: [x]\nT: x'^2/2\n", "the key is coordinates"),
    (text(coordinates="[x y]", T="x'^2", V=None), "write x, y"),
    (text(parameters="m=1, k=2"), "write {m: 1, k: 2}"),
    (text(parameters="{m: kg, k: 2}"), "write {unit: kg}"),
    (text(parameters="{m: {assume: '>0'}, k: 2}"), "write positive"),
    (text(parameters="{m: {positive: true}, k: 2}"), "write assume: positive"),
    (text(parameters="{m: 1, k: 50%}"), "write 50/100"),
    (text(initial="{x: 30 deg}"), "write 30*pi/180"),
    (text(initial="{x: pi/4 rad}"), "write pi/4: numbers are in the units of the file"),
    (text(initial="{x: math.pi/2}"), "write pi"),
    (text(initial="{x(0): 1}"), "write x"),
    (text(initial="{x'(0): 1}"), "write x'"),
    (text(V="½ k x"), "did you mean (1/2)*k"),
    (text(V="k*np.cos(x)"), "write k*cos(x)"),
    (text(V="k*\\frac{x}{2}"), "write k*(x/2)"),
    (text(V="k*\\sqrt{x}"), "write k*sqrt(x)"),
    (text(T="m*\\dot{x}^2/2"), "write m*x'^2/2"),
    (text(T="m*\\dot x^2/2"), "write m*x'^2/2"),
    (text(T="m*(dx/dt)^2/2"), "write m*x'^2/2"),
    (text(T="m*v^2/2"), "write m*x'^2/2"),
    (text(V="k*heaviside(x)"), "write k*((1 + sign(x))/2)"),
    (text(V="k*max(x, 1)"), "write k*((x + 1 + abs(x - 1))/2)"),
    (text(V="k*cos(x"), "did you mean k*cos(x)?"),
    (text(V="k*x;"), "write k*x"),
    (text(gravity="9.81"), "write V: k*x^2/2 + m*g*x"),
    (text(gravity="[0, -9.81]", V=None), "write V: m*g*x"),
    (
        text(gravity="9.81", V="m*gravity*x"),
        "write all as parameters: {m: 1, k: 2, g: 9.81, gravity: 9.81}",
    ),
    (text(friction="-k*x'"), "write dissipation: k*x'^2/2"),
    (text(dissipation="{x: k*x'}"), "write k*x'^2/2"),
    (text(until="10"), "write simulation: {until: 10}"),
    (text(simulation="10"), "write {until: 10}"),
    (text(simulation="{until: inf}"), "there is no infinity"),
    (text(find="{top: x = 0}"), "write {where: x = 0, for: x}"),
    (text(points="{bob: [x, 0]}"), "write {position: [x, 0]}"),
    (text(T="m*x'^2/2 [J]"), "leave out '[J]'"),
    (text(V="k*x^2/2 [N m]"), "leave out '[N m]'"),
    (text(V="k*cos[x]"), "write k*cos(x)"),
    (text(V="k*x^{2}"), "write k*x^2"),
    (text(V="k*tg(x)"), "did you mean k*tan(x)?"),
    (text(V="k*ch(x)"), "did you mean k*cosh(x)?"),
    (text(V="k*ctg(x)"), "did you mean k*cot(x)?"),
    (text(V="k*x^2)"), "did you mean (k*x^2)?"),
    (text(V="k*x^"), "leave out '^'"),
    (text(V="k*x if x > 0 else 0"), "write (k*x)*(1 + sign(x))/2"),
    (text(V="0 for x < 0"), "(1 + sign(x))/2 is 1 for x > 0"),
    (text(V="1,000*x"), "a decimal point is written '.'"),
    (text(V="[k*x^2/2, m*g*x]"), "write k*x^2/2 + m*g*x"),
    (text(V="{spring: k*x^2/2, weight: m*g*x}"), "write k*x^2/2 + m*g*x"),
    (text(T="\n  - m*x'^2/4\n  - m*x'^2/4"), "write m*x'^2/4 + m*x'^2/4"),
    (text(T="p^2/(2*m)"), "write m*x'^2/2, or give H: p_x^2/(2*m) + V"),
    (text(T="p_x^2/(2*m)"), "write m*x'^2/2, or give H: p_x^2/(2*m) + V"),
    (text(coordinates="[x, x]"), "leave out one of them"),
    (text(coordinates="[x, m]", T="m*x'^2"), "leave it out of the coordinates"),
    (text(coordinates="(x, y)"), "write [x, y]"),
    (text(coordinates="x and y"), "write [x, y]"),
    (text(coordinates="x(t), y(t)"), "write [x, y]"),
    (text(coordinates="[x(t)]"), "write x"),
    (text(coordinates="1"), "such as [x, y]"),
    (text(coordinates="[1x]"), "write x1"),
    (text(coordinates="[t]"), "t_1"),
    ("coordinates:\n- x\n -y\nT: x'^2\n", "write x, y"),
    ("coordinates:\n  - x: {unit: m}\nT: x'^2\n", "write {x: {unit: m}}"),
    (text(parameters="[m = 1, k = 2]"), "write {m: 1, k: 2}"),
    (text(parameters="{m 1, k 2}"), "write {m: 1, k: 2}"),
    (text(parameters="\n  - m: 1\n  - k: 2"), "write {m: 1, k: 2}"),
    (text(parameters="{m: 1; k: 2}"), "write parameters: {m: 1, k: 2}"),
    (text(parameters="{m: '> 0', k: 1}"), "write m: {assume: positive}"),
    (text(parameters="{m: 1, k: ≠0}"), "write k: {assume: nonzero}"),
    (text(parameters="{m: {unit: Kg}, k: 2}"), "did you mean 'kg'"),
    (text(parameters="{m: 1, m: 3, k: 2}"), "leave out one of them"),
    (text(initial="{x: 1, dx: 0}"), "the velocity of x is x'"),
    (text(initial="{x: 1, v_x: 0}"), "the velocity of x is x'"),
    (text(simulation="{t_end: 10}"), "the key is until"),
    (text(simulation="{time: 10}"), "the key is until"),
    (text(simulation="{until: 10, dt: 0.01}"), "write accuracy: 1e-9"),
    (text(simulation="{until: 10, tol: 1e-6}"), "the key is accuracy"),
    (text(tmax="10"), "write simulation: {until: 10}"),
    (text(constraints="{rod: x = 1 = k}"), "an equation of its own"),
    (text(constraints="{rod: }"), "write left = right"),
    (text(contacts="{floor: x = 0}"), "write x >= 0"),
    (text(units="SI"), "leave it out: a unit stands with its name, m: {unit: kg}"),
    (text(author="me"), "the key is source"),
    (text(L="T - V"), "leave out L: it is T - V"),
    ("T: m*x'^2/2\nV: k*x^2\n", "write coordinates: [x]"),
    ("m*x'^2/2 - k*x^2/2\n", "write L: m*x'^2/2 - k*x^2/2"),
    ("coordinates:[x]\nT: x'^2\n", "write coordinates: [x]"),
    ("coordinates: [x]\nT: 'x'^2'\n", "T: x'^2"),
    ("coordinates: [x]\nT: \"x'^2\nV: x\n", 'write T: "x\'^2"'),
    ("coordinates: [x\nT: x'^2\n", "write coordinates: [x]"),
    (text(V="m*g*x  // weight"), "a comment begins with '#'"),
    (text(V="k/2*x^2 % spring"), "a comment begins with '#'"),
    (text(V="k*x^2/2 = E"), "leave out '=' and what follows it"),
    (text(V="k*x.^2"), "write k*x^2"),
    (text(V="k.*x"), "write k*x"),
    (text(V="k*x*i"), "every quantity is real"),
    (text(V="T:"), "a second ':'"),
    (text(T=""), "or leave out its key"),
    (text(parameters="{m: [1, 2], k: 2}"), "lagcli sweep p.yaml --vary m=1,2"),
    (text(parameters="{m: ?, k: 2}"), "write parameters: {m: , k: 2}"),
    (text(parameters="{m: 1±0.1, k: 2}"), "write 1"),
    (text(parameters="{m:1, k:2}"), "write {m: 1, k: 2}"),
    (text(parameters="{m: const, k: 2}"), "write m:"),
    (text(parameters="{m: {default: 1}, k: 2}"), "the key is value"),
    (text(parameters="none", T="x'^2", V=None), "leave out the key"),
    (text(initial="{x: [1, 0]}"), "write x: 1, x': 0"),
    (text(ics="{x: 1}"), "the key is initial"),
    (text(T=None, K="m*x'^2/2"), "the key is T"),
    (text(coordinates="[x_{1}]"), "write coordinates: [x_1]"),
    (text(coordinates="{x: real}"), "write {assume: real}"),
    (text(coordinates="{x: m}"), "write {unit: m}"),
    (text(coordinates="q1..q3", T="q1'^2", V=None), "write [q1, q2, q3]"),
    (text(T="m*v^2/2", definitions="v = x'"), "write {v: x'"),
    (text(T="m*v^2/2", definitions="\n  - v = x'"), "write {v: x'"),
    (text(T=None, points="\n  bob: (x, 0)"), "write {position: [x, 0]}"),
    (text(T=None, points="{bob: {pos: [x, 0], mass: m}}"), "the key is position"),
    (text(T=None, points="{bob: {mass: m}}"), "write position: [x, y]"),
    ("- coordinates: [x]\n- T: x'^2\n", "leave out the '-' before each key"),
    (text(T=None, points="{bob: {x: x, y: 0, mass: m}}"), "write bob: {position: [x, 0], mass: m}"),
    (text(T=None, points="{bob: {position: [x, 0], mass: 1 kg}}"), "write 1"),
    (text(dissipation="k*x'"), "dissipation: c*x'^2/2"),
    (text(dissipation="-k*x'^3"), "write forces: {x: -k*x'^3}"),
    (text(dissipation="v", definitions="{v: k*x'}"), "dissipation: c*x'^2/2"),
    (text(dissipation="k*x"), "contains no velocity"),
    (text(forces="{drag: -k*x'}"), "write x: -k*x'"),
    (text(forces="F(t) = k*sin(t)"), "write {x: k*sin(t)"),
    (text(Q="{x: 1}"), "the key is forces"),
    (text(V="mgx"), "write m*g*x"),
    (text(V="mg*x"), "write m*g*x"),
    (text(T="m*x'2/2"), "did you mean m*x'^2/2"),
    (text(T="m*D(x)^2"), "write m*x'^2"),
    (text(T="m*norm([x', 0])^2/2"), "write m*sqrt(x'^2 + 0^2)^2/2"),
    (text(T="m*x'^2/2 - V"), "V is a key and not a name"),
    (text(V="∫ k*x dx"), "write the antiderivative"),
    (text(V="integrate(k*x, x)"), "write the antiderivative"),
    (text(V="sum(k*x, i, 1, 3)"), "write each term"),
    (text(V="k*root(x)"), "did you mean k*sqrt(x)?"),
    (text(V="k*atan(x, 1)"), "write k*atan2(x, 1)"),
    (text(V="k*atan2(x/2)"), "write atan2(y, x) for y/x"),
    (text(V="k*log(x, 10)"), "write log(x)/log(b)"),
    (text(V="k*cos(x,)"), "leave out ','"),
    (text(V="k*x^2/2,"), "write k*x^2/2"),
    (text(V="k*x^2/2 J"), "write k*x^2/2: numbers are in the units of the file"),
    (text(V="{k*x^2/2}"), "write k*x^2/2"),
    (text(V="$k*x^2/2$"), "write k*x^2/2"),
    (text(V="k*1_000"), "write k*1000"),
    (text(V="“k*x^2/2”"), "write k*x^2/2"),
    (text(V="U(x)", functions="U(x)"), "write {U: [x]}"),
    (text(V="U(x)", functions="[U]"), "write {U: [x]}"),
    (text(V="U(x)", functions="{U: k*x^2}"), "write definitions: {U: k*x^2}"),
    (text(V="U(x)", functions="{U(x): k*x^2}"), "write definitions: {U: k*x^2}"),
    (text(definitions="{f(x): x^2}"), "write f"),
    (text(constraints="{rod: x^2 + 1 <= 2}"), "write contacts: {rod: x^2 + 1 <= 2}"),
    (text(constraints="{rod: x != 1}"), "write an equation with '='"),
    (text(constraints="{rod: x := 1}"), "write x = 1"),
    (text(constraints="{x^2 = 1}"), "write name: x^2 = 1"),
    (text(constraints="{rod: {x: 1}}"), "write rod: {equation: x = 1}"),
    (text(constraints="{rod: {equation: x = 1, lambda: N}}"), "the key is multiplier"),
    (text(contacts="{floor: {gap: x, e: 1}}"), "the key is restitution"),
    (text(coordinates="{x: 0}"), "a state stands under initial"),
    (text(coordinates="{x: {initial: 1}}"), "a state stands under initial"),
    (text(coordinates="{x: angle}"), "write {unit: rad}"),
    (text(coordinates="x[t]"), "write [x]"),
    ("coordinates:\n  - x\n  - y:\nT: x'^2 + y'^2\n", "write y"),
    (text(parameters="{m: 1 000, k: 2}"), "write 1000"),
    (text(parameters="{m: {assume: [positive]}, k: 2}"), "write positive"),
    (text(parameters="{m > 0, k}"), "write m: {assume: positive}"),
    (text(parameters="{m/2: 1, m: 1, k: 2}"), "write m_2"),
    (text(initial="{t: 0, x: 1}"), "a motion begins at t = 0"),
    (text(initial="{x_0: 1}"), "write x"),
    (text(initial="{x: 1,5}"), "a decimal point is written '.'"),
    (text(initial="{x: 90º}"), "write 90*pi/180"),
    (text(initial="{x = 1}"), "write x: 1"),
    (text(x0="1"), "write initial: {x: 1}"),
    (text(simulation="{until: 1 min}"), "write 1*60"),
    (text(simulation="{until: [0, 10]}"), "write 10"),
    (text(simulation="[0, 10]"), "write {until: 10}"),
    (text(simulation="{from: 0, until: 10}"), "a motion begins at t = 0"),
    (text(simulation="{until: 10, accuracy: high}"), "only a number can stand here"),
    (text(system="pendulum"), "the key is title"),
    (text(T=None, V=None, equations="[x'' = -k*x]"), "the equations of motion are derived"),
    (text() + "x'' = -k*x\n", "the equations of motion are derived"),
    (text(expect="{dof: 1}"), "the key is degrees_of_freedom"),
    (text(find="{a: x''}"), "write {value: x'', in_terms_of: [x]}"),
    (text(find="{a: {solve: x = 0, for: x}}"), "write a: {where: x = 0, for: x}"),
    (text(symmetries="{shift: {x: x + eps}}"), "write {x: 1}"),
    (text(symmetries="{grow: {x: x - s*x}}"), "write {x: -x}"),
    (text(T="m*(x'^2 + x^2*phi'^2)/2"), "unknown name 'phi' in T; declare it under 'coordinates'"),
    (text(T=None, t="m*x'^2/2"), "the key is T"),
    (text(forces="[F1 = -k*x]"), "write {x: -k*x}"),
    (text(initial="{'x: 1}"), "write initial: {x: 1}"),
    (text(initial="{'x: 1, x': 0}"), "write {x: 1, x': 0}"),
    (text(initial="{x: 1,5, x': 0}"), "a decimal point is written '.': write x: 1.5"),
    (text(V="1,000*x"), "write 1.000, or 1000 for thousands"),
    (text(T="m*x[1]'^2/2", coordinates="[x_1]", V="0"), "write m*x_1'^2/2"),
    (text(constraints="{roll: without slipping}"), "a sentence is no formula; write left = right"),
    (text(parameters="{m: 1, k: two newtons}"), "write {value: 2, unit: N}"),
    (text(impacts="{floor: x = 0}"), "contacts: {floor: y >= 0}"),
    (text(parameters="\n  - m is the mass\n  - k, stiffness of it"), "write [m, k]"),
    (text(parameters="\n  m 1\n  k 4"), "write {m: 1, k: 4}"),
    (text() + "l = 3\n", "write all as parameters: {m: 1, k: 2, g: 9.81, l: 3}"),
    ("m = 1; k = 4;\nT = m*x'[t]^2/2;\n", "write parameters: {m: 1, k: 4}"),
    ("% a pendulum\nm = 1; l = 2;\nT = m*l^2;\n", "keys with their values"),
    ("coordinates => [x]\nT => x'^2\n", "write coordinates: [x]"),
    (
        f"one:\n  {text()[:-1]}\ntwo:\n  {text()}".replace("\nT", "\n  T")
        .replace("\nV", "\n  V")
        .replace("\np", "\n  p"),
        "a file of its own",
    ),
    (text(initial="released from rest at 0.5 m"), "write {x: 0.5}"),
    (text(contacts="{floor: the ball bounces with e = 0.8}"), "write {gap: y >= 0, restitution"),
    (text(forces="a harmonic force k*cos(t)"), "write {x: k*cos(t)}"),
    (text(V="the energy of the spring k*x^2/2"), "write k*x^2/2"),
    (text(simulation="ten seconds"), "write {until: 10}"),
    (text(constraints="{rest: x is 0}"), "did you mean x = 0?"),
    (
        text(points="{a: {position: [x, 2*x], mass: m}}", T=None, V="m*g*a[1]"),
        "a component of a point is written by its formula",
    ),
    (text() + ";\n", "leave it out"),
    (text(coordinates="\n  1: x\n  2: y"), "write [x, y]"),
    (text(parameters="{m: (1, kg), k: 4}"), "write {value: 1, unit: kg}"),
    (text(parameters="{m: 1*10^-3 kg, k: 4}"), "write {value: 1*10^-3, unit: kg}"),
    (text(parameters="{m: 2 Kilogramm, k: 4}"), "write {value: 2, unit: kg}"),
    (text(parameters="{m: 2 mètres, k: 4}"), "write {value: 2, unit: m}"),
    (text(T="m*x'^2/2 in Joule"), "a comment begins with '#'"),
    (text(V="{x > 0: k*x^2/2, x < 0: 0}"), "(1 + sign(x))/2"),
    (text(description="a spring\nwith friction: small"), "put the whole text in quotes"),
    (text(initial="{x: 1 at t = 0}"), "leave out 'at t = 0'"),
    (text(initial="x 1, x' 0"), "write {x: 1, x': 0}"),
    (text(simulation="until = 5"), "write {until: 5}"),
    (text(parameters="{m: 1, k: 2  # stiffness}"), "write parameters: {m: 1, k: 2}"),
    (text(coordinates="['x]"), "write coordinates: [x]"),
    (text(constraints="{rod: x = 1 [m]}"), "write constraints: {rod: x = 1}"),
    (text(constraints="{rod: x = 1, N}"), "write rod: {equation: x = 1, multiplier: N}"),
    (text(constraints="{rod: x = 1 for all t}"), "leave out 'for all t'"),
    (text(constraints="{rod: x -> 1}"), "write x = 1"),
    (text(V="k*x**2/2 + λ*x**4"), "unknown name 'λ' in V; declare it: parameters: "),
    (text(T=None, points="{bob: m}"), "write {position: [x, y], mass: m}"),
    (text(T=None, points="[bob]"), "write bob: {position: [x, y], mass: m}"),
    (text(V=None, V1="k*x^2/2", V2="-m*g*x"), "it is one sum: write V: k*x^2/2 - m*g*x"),
    (text(T=None, T_1="m*x'^2/2", T_2="k*x'^2"), "it is one sum: write T: m*x'^2/2 + k*x'^2"),
    (text(parameters="{m: 1,5; k: 4,2}"), "write {m: 1.5, k: 4.2}"),
    (text(V="- k x^2/2"), "write V: -k*x^2/2"),
    (text(T="x'' = -k/m*x"), "the equations of motion are derived"),
    (text(dissipation="{x: -k*x'}"), "these are forces: write forces: {x: -k*x'}"),
    (text(dissipation="[k*x'^2/2, m*x'^2]"), "write k*x'^2/2 + m*x'^2"),
    (text(find="{period: 2*pi*sqrt(m/k)}"), "leave it out: equilibria, frequencies"),
    (text(T="m*x'<sup>2</sup>/2"), "write m*x'^2/2"),
    (text(T="m dot x^2/2"), "did you mean m*x'^2/2?"),
    (text(coordinates="[s]", T="m x s'^2/2", V=None), "did you mean m*s'^2/2?"),
    (text(coordinates="[x, y]", T="m*(x', y').(x', y')/2"), "write m*(x'*x' + y'*y')/2"),
    (text(coordinates="[r, phi]", T="m*v^2/2", V=None), "write m*(r'^2 + r^2*phi'^2)/2"),
    (
        text(coordinates="[r, theta, phi]", T="m*v^2/2", V=None),
        "write m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2",
    ),
    (
        text(coordinates="[rho, phi, z]", T="m*v²/2", V=None),
        "write m*(rho'^2 + rho^2*phi'^2 + z'^2)/2",
    ),
    (text(V="k*(x^2 + 0,5*(x + 1))"), "write k*(x^2 + 0.5*(x + 1))"),
    (text(parameters="{m: {unit: kg, value = 1}, k: 2}"), "write value: 1"),
    (text(points="{a: {position: x, 0, mass: m}}", T=None), "write position: [x, 0]"),
    (text(T="m*(d(x)/dt)^2/2"), "write m*x'^2/2"),
    (text(V="k*x (energy of the spring)"), "a remark is no part of a formula"),
    (text(T=None) + "T:-x'^2\n", "write T: -x'^2"),
    (
        text(points="{a: {position: (2*(x + cos(2*(x + 1))), (x)), mass: m}}", T=None),
        "write [2*(x + cos(2*(x + 1))), (x)]",
    ),
    (
        text(constraints="{rod: {equation: x = 1, multiplier: N, holds_while: N is positive}}"),
        "did you mean N >= 0?",
    ),
    (text(parameters="{m: 1/2 kg, k: 2}"), "write {value: 1/2, unit: kg}"),
    (text(forces="{x: k*sin(w*t)}", parameters="{m: 1, k: 2, omega: 3}"), "did you mean 'omega'?"),
    (text(functions="{U: [x]}", V="U"), "write U(x)"),
    (text(coordinates="[phi]", T=None, V=None, H="pφ^2/(2*m)"), "write p_phi^2/(2*m)"),
    (text(coordinates="[r]", T=None, V=None, H="m*r'^2/2"), "has momenta p_r, no velocities"),
    (text(points="{bob: {position: {x, 2*x}, mass: m}}", T=None), "write [x, 2*x]"),
    (
        text(points="{a: {position: [x]}, b: {position: [x]}}", picture="{rods: [a-b, b - a]}"),
        "write [[a, b], [b, a]]",
    ),
    (text(simulation="{until: 10^(3}"), "did you mean 10^(3)?"),
    (
        text(observables="{J: x*p_x}", brackets="{zero: [J, x] = 0}"),
        "write brackets: {zero: [J, x]}",
    ),
    (text(constraints="\n  rod\n    equation: x = 1"), "a ':' is missing behind 'rod'; write rod:"),
    (
        text(constraints="\n  rod:\n  equation: x = 1\n    multiplier: N"),
        "'equation' stands below 'rod', but not in it; begin the line with more blanks",
    ),
    (
        text(
            constraints="{rod: {multiplier: N, holds_while: N >= 0}}",
            find="{n: {value: N, in_terms_of: [x]}}",
        ),
        "write rod: {equation: left = right}",
    ),
    (text(dynamics="[m*x'' = -k*x]"), "the equations of motion are derived"),
    (text(T=None, V=None, Lagrangian="L = m*x'^2/2"), "the key is L; write m*x'^2/2"),
    (text(points="{bob: {position: r = x i + 2 j, mass: m}}", T=None), "write [x, 2]"),
    (text(coordinates="[х]", V=None), "Cyrillic small letter ha"),
    (text(V="!x"), "leave it out"),
    (text() + "+ 3\nL: x\n", "begin the line further right: it goes on with line 4"),
    (text() + "// spring\nL: x\n", "a comment begins with '#'"),
    (text(V="x /* spring */"), "a comment begins with '#'"),
    (" coordinates: [x]\nT: x'^2\n", "begin them alike"),
    ("{coordinates: [x], T: x'^2,\n", "write its ']' or '}'"),
    ("coordinates: [x]\nT:x'^2\n", "write T: x'^2"),
    (text(coordinates="[x, y]", T="m*v^2/2"), "write m*(x'^2 + y'^2)/2"),
    (text(initial="[1, 0]"), "write {x: 1, x': 0"),
    (text(initial="x = 1"), "write {x: 1"),
    (text(initial="{omega: 1}"), "known are x and velocities: x'"),
    (text(coordinates="[x₁]", T="x₁'^2", V=None, initial="{x₁: 1, x: 0}"), "write x_1"),
    ("T: x'^2/2\nV: x\ninitial: {x: 1, x': 0}\n", "write coordinates: [x]"),
    (text(simulation="{tspan: 10}"), "the key is until"),
    (text(forces="[-g*x']"), "write {x: -g*x'"),
    (text(forces="{F_x: -g*x'}"), "write x"),
    (text(symmetries="[rotation]"), "write {rotation: {x: 1}}"),
    (text(symmetries="{later: t -> t + eps}"), "write {t: 1}"),
    (text(constraints="{rod: lambda*(x - 1)}"), "written without its multiplier"),
    (text(V="integral(k*x, x)"), "write the antiderivative"),
    (text(V="m*dot(g, r)"), "write the sum over the components"),
    (text(V="piecewise(x < 0, 0, k)"), "(1 + sign(x))/2"),
    (text(V="if(x > 0, k*x, 0)"), "(1 + sign(x))/2"),
    (text(V="k*(x - x0)^2/2"), "declare it: parameters: {m: 1, k: 2, g: 9.81, "),
    (text(V=None) + "V(x): k*x\n", "the key is V"),
    (text(expect="{x'': -g}"), "write accelerations: {x: -g}"),
    (text(coordinates="{x: height}"), "write {description: height}"),
    (text(parameters="{m: {unit: kilogramm}, k: 1}"), "write kg"),
    (text(T="-m*x'^2/2"), "a kinetic energy is positive"),
    (text(T="m*x*x'"), "of second degree"),
    (text(dissipation="-k*x'^2/2"), "it drives the motion"),
    (text(definitions="{v: x'}", T="-m*v^2/2"), "a kinetic energy is positive"),
    ("---\n", "write coordinates: [x]"),
    ("{}\n", "write coordinates: [x]"),
    # written by other hands, on another day
    (text(parameters="{m: 1, k: 0.3 m}"), "write {value: 0.3, unit: m}; the product is 0.3*m"),
    (text(initial="{x: 0.1 m}"), "write 0.1: numbers are in the units of the file"),
    (text(coordinates="- x\n  - y"), "begin the list on a new line"),
    (text(simulation="{final_time: 5}"), "the key is until"),
    (text(forces="{x: -mu*k}"), "declare it: parameters: {m: 1, k: 2, g: 9.81, "),
    (text(coords="[x]", coordinates=None), "the key is coordinates"),
    (text(coordinates="{x: [m]}"), "write {unit: m}"),
    (text(coordinates="{x: [0, 2*pi]}"), "a coordinate has no range"),
    (text(coordinates="[x; y]"), "write x, y"),
    (text(coordinates="[q1, ..., qn]", T="q1'^2", V=None), "every name in full"),
    (text(parameters="\nm: 1\nk: 2"), "begin the line with blanks"),
    (text(initial="\nx: 1\nx': 0"), "begin the line with blanks"),
    (text(parameters="{m: 1, k: 30deg}"), "write 30*pi/180"),
    (text(parameters="{m: {value=1}, k: 2}"), "write value: 1"),
    (text(parameters="{m: 1, k: 3*cos(t)}"), "write definitions: {k: 3*cos(t)}"),
    (text(parameters="{m: 1 [kg], k: 2}"), "write {value: 1, unit: kg}"),
    (text(parameters="{m: >0, k: 2}"), "write parameters: {m: {assume: positive}, k: 2}"),
    (text(parameters="{m: int, k: 2}"), "write m: {integer: yes}"),
    (text(parameters="{m: 0,5, k: 2}"), "a decimal point is written '.'"),
    (text(parameters="{m: 1, k: 2, pi: 3.14}"), "choose another name: pi_1"),
    (text(initial="x = 1, x' = 0"), "write {x: 1, x': 0}"),
    (text(initial="\n  x(0) = 1\n  x'(0) = 0"), "write {x: 1, x': 0}"),
    (text(initial="[x: 1, x': 0]"), "write {x: 1, x': 0}"),
    (text(initial="{0: {x: 1}}"), "write {x: 1}"),
    (text(initial="{x: none}"), "write 0"),
    (text(state="{x: 1}"), "the key is initial"),
    (text(simulation="{T: 10}"), "the key is until"),
    (text(simulation="{until: 10, samples: 100}"), "--samples 100"),
    (text(simulation="until: 10"), "write simulation: {until: 10}"),
    (text(simulation="until 10"), "write {until: 10}"),
    (text(simulation="{until: 10, method: rk4}"), "write dop853"),
    (text(constraints="none"), "leave out the key"),
    (text(constraints="{rod: x = k and x = m}"), "own name: rod_1: x = k, rod_2: x = m"),
    (text(constraints="{rod: |x| = k}"), "is written abs(x)"),
    (text(forces="{bob: [0, -m*g]}"), "or as 'force' of a point"),
    (text(forces="{x: k*cos(ωt)}"), "did you mean k*cos(ω*t)?"),
    (text(plot="true"), "lagcli plot p.yaml"),
    (text(T=None, V=None, H="p_x^2/(2*m)", momenta="[p]"), "momenta are named p_x"),
    (text(find="{omega: }"), "write {value: …, in_terms_of: [x]}"),
    (
        "coordinates: [x]\nT: x'^2/2  V: x^2/2\n",
        "write T: x'^2/2, and on a line of its own V: x^2/2",
    ),
    (
        "coordinates: [x]\nT = x'^2/2; V = x^2/2\n",
        "write T: x'^2/2, and on a line of its own V: x^2/2",
    ),
    (
        text(coordinates="[y]", T="m*y'^2", V=None, contacts="{ceiling: true}"),
        "write ceiling: {gap: y <= …}",
    ),
    ("title: Pendulum: simple\n" + text(), 'write title: "Pendulum: simple"'),
    ("```yaml\n" + text() + "```\n", "leave out '```yaml'"),
    (text(V="none"), "write 0"),
    (text(V="m*g*x#weight"), "a comment has a blank before it: write m*g*x #weight"),
    (text(V="k*x^2\\2"), "division is written with '/'"),
    (text(V="k*x^2/2 where k = 3"), "values stand under 'parameters'"),
    (text(V="m*g*(1 - cosx)"), "write m*g*(1 - cos(x))"),
    (text(V="mg(1 - cos(x))"), "write m*g*(1 - cos(x))"),
    (text(V="k*tan^-1(x)"), "write k*atan(x)"),
    (text(V="k*x?"), "leave it out"),
    (
        text(coordinates="[x, y]", T="m*(x'^2 + y'^2)/2", V="k*m/r"),
        "write r by them under 'definitions'",
    ),
    ("Freiheitsgrade: [x]\nT: x'^2/2\n", "the key is coordinates"),
    ("coordinates: [x]\nmasses: [m]\nT: m*x'^2/2\n", "the key is parameters"),
    ("coordinates: [x]\nconsts: [m]\nT: m*x'^2/2\n", "the key is parameters"),
    ("coordinates: [x]\nKonstanten: {m: 1}\nT: m*x'^2/2\n", "the key is parameters"),
    (text(Anfang="{x: 1, x': 0}"), "the key is initial"),
    (
        "coordinates: [x]\nenergies:\n  T: x'^2/2\n  V: x\n",
        "leave it out, and begin lines with T: x'^2/2, V: x",
    ),
    (text(forces="x -> m*g"), "write {x: m*g"),
    (text(simulation="{until: 3 T}"), "write the number that 3 T is"),
    (text(simulation="{until: 3, accuracy: 8 digits}"), "write 1e-8"),
    (text(simulation="{until: 3, accuracy: 8}"), "write 1e-8"),
    (text(points="[bob: [x, 0]]"), "write {bob: {position: [x, 0]}}"),
    ("coordinates: [x_1..x_3]\nT: x_1'^2 + x_2'^2 + x_3'^2\n", "write x_1, x_2, x_3"),
    (text(expect="x = cos(t)"), "write {trajectory: {x: cos(t)}}"),
    (text(V="k*(x-a)^2/2"), "declare it: parameters: {m: 1, k: 2, g: 9.81, "),
    (text(V="(3 kg)*g*x"), "write 3*g*x: numbers are in the units of the file"),
    (text(initial="{x': 10 deg/s}"), "write 10*pi/180"),
    (text(parameters="{m: 1, k: 90 deg/s}"), "write {value: 90*pi/180, unit: rad/s}"),
    (text(T="\\begin{equation*} m*x'^2/2 \\end{equation*}"), "write m*x'^2/2"),
    (text(V="k*x^2/2g"), "did you mean k*x^2/(2*g)?"),
    (text(T="p_x^2/2m"), "write m*x'^2/2, or give H: p_x^2/(2*m) + V"),
    (text(parameters="{m: 1, k: 30 rpm}"), "write {value: 30*pi/30, unit: rad/s}"),
    (text(V="k*x^2/2 (J)"), "write k*x^2/2: numbers are in the units of the file"),
    (text(velocities="[v]"), "the velocity of x is x'"),
    (text(coordinates="[theta]", T="m*(dθ/dt)^2/2", V=None), "write m*theta'^2/2"),
    (text(initial="{x: [30, deg]}"), "write 30*pi/180"),
    (text(V="k*(x - M_PI_2)^2"), "write k*(x - (pi/2))^2"),
    (text(parameters="{m: 1, k: math.pi}"), "write pi"),
    (text(parameters="\n  m: 1\n  k: %pi"), "write k: pi"),
    (text(forces='{x: "-sign(k, x\')"}'), "write -abs(k)*sign(x')"),
    (text(forces='{x: "-math.copysign(2.5, x\')"}'), "write -2.5*sign(x')"),
    (text(contacts="{floor: x .ge. 0.}"), "write x >= 0."),
    (text(contacts="{floor: x.GT.0 .and. x.lt.10}"), "lower: x >= 0, upper: x <= 10"),
    (text(constraints="{c: x .Eq. k}"), "write x = k"),
    (text(constraints="{c: x .le. k}"), "write contacts: {c: x <= k}"),
    (text(parameters="{k: {unit: Grad, value: 30}}"), "write unit: rad, value: 30*pi/180"),
    (text(parameters="{k: {unit: grad/s, value: 9}}"), "write unit: rad/s, value: 9*pi/180"),
    (text(parameters="{k: {unit: Gon, value: 50}}"), "write unit: rad, value: 50*pi/200"),
    (text(parameters="{k: {unit: Min}}"), "did you mean 'min'"),
    (text(constraints="{floor: x => 0}"), "write contacts: {floor: x >= 0}"),
    (text(V="{0 if x < 0, k*x}"), "(1 + sign(x))/2"),
    (text(V="k*mod(x, 1)"), "a jump is written with sign"),
    (text(points="{P: {position: [x], mass: m, gravity: g}}"), "write V: m*g*y"),
    (text(expect="{omega: sqrt(k/m)}"), "frequencies stand under modes"),
    ("coordinates: [x]\nL = T - V = x'^2/2\n", "write L: x'^2/2"),
    ("coordinates: [x]\nL: T - V = x'^2/2\n", "write x'^2/2"),
    (text(V="Σ k*x^2/2"), "write each term"),
    (text(initial="{'x': 1, 'x'': 0}"), "write initial: {'x': 1, x': 0}"),
    (text(simulation="{until: 10, step_size: 0.01}"), "write accuracy: 1e-9"),
    (text(parameters="{m: {assume: pos}, k: 2}"), "write positive"),
    (text(forces="{x: k*dirac(t)}"), "a velocity under initial"),
    (
        text(T="m*x'^2/2 + lambda*(x - 1)"),
        "m*x'^2/2, and on a line of its own constraints: {c1: x = 1}",
    ),
    ("coordinates: [x]\nParameters: [m]\nT: m*x'^2/2\n", "the key is parameters"),
    (text(V='f"{k}*x^2/2"'), "write k*x^2/2"),
    ("from sympy import *\nimport numpy as np\n" + text(), "leave it out"),
    ("coordinates: [x];\nT: x'^2/2;\n", "write coordinates: [x]"),
    (text(parameters="dict(m=1, k=sqrt(2))"), "write {m: 1, k: sqrt(2)}"),
    (text(parameters="\n  - [m, 1]\n  - [k, 2]"), "write {m: 1, k: 2}"),
    (text(parameters="\n  m:1\n  k:2"), "write {m: 1, k: 2}"),
    (text(parameters="{m： 1, k: 2}"), "write m: 1"),
    (
        text(parameters="{m: 1..3, k: 2}"),
        "write 1; several are run by lagcli sweep p.yaml --vary m=1:3:3",
    ),
    (
        text(parameters="{m: 1 to 3, k: 2}"),
        "write 1; several are run by lagcli sweep p.yaml --vary m=1:3:3",
    ),
    (text(parameters=None, masses="{m: 1}", V=None), "the key is parameters"),
    (text(gravity="-x"), "write V: k*x^2/2 + m*g*x"),
    (
        text(
            coordinates="[theta]",
            parameters="[m, l]",
            T=None,
            V=None,
            points="{a: {position: [l*sin(theta), -l*cos(theta)], mass: m}}",
            gravity="9.81 m/s^2",
        ),
        "write V: -m*g*l*cos(theta), with g: 9.81 under parameters",
    ),
    (text(damping="0.1"), "write dissipation: 0.1*x'^2/2: its force is -0.1*x'"),
    (text(time="t"), "t is the time"),
    (text(forces="{x: k*cos(g*time)}"), "the time is t"),
    (text(symmetries="{rotation: true}", coordinates="[x, y]", T="x'^2 + y'^2"), "{x: -y, y: x}"),
    (text(constraints="{rod: m = 1}"), "a value stands under 'parameters'"),
    (text(forces="[x, -k*x']"), "write {x: -k*x'}"),
    (text(find="[equilibria, period]"), "leave it out: equilibria"),
    (text(find="{where: x' = 0, for: x}"), "write name: {where: x' = 0, for: x}"),
    (text(find="{turns: x' = 0}"), "write {where: x' = 0, for: x}"),
    (text(contacts="{floor: x >= 0, restitution: 0.8}"), "floor: {gap: x >= 0, restitution: 0.8}"),
    (text(contacts="{gap: x >= 0, restitution: 0.8}"), "name: {gap: x >= 0, restitution: 0.8}"),
    (text(constraints="{c: x = 1, multiplier: N}"), "write c: {equation: x = 1, multiplier: N}"),
    (text(constraints="{c: {f: x^2 - 1}}"), "write c: {equation: x^2 - 1 = 0}"),
    (text(points="{ball: x, y}"), "write {position: [x, y]}"),
    (text(V2="k*x"), "write V: k*x^2/2 + k*x"),
    (text(V_spring="k*x"), "write V: k*x^2/2 + k*x"),
    (text(symmetries="{time: true}"), "write {t: 1}"),
    (text(symmetries="[x]"), "write {shift: {x: 1}}"),
    (text(observables="[x^2]"), "write {A: x^2}"),
    (text(cyclic="[x]"), "what is conserved is found"),
    (text(expect="{modes: sqrt(k/m)}"), "write [sqrt(k/m)]"),
    (text(expect="{find: {a: 1}}"), "it is declared first"),
    (text(forces="{x: -k*sgn(x')}"), "-k*sign(x')"),
    ("coordinates: [ẋ]\nT: 0\n", "write x; its velocity is x'"),
    (text(functions="[U(x)]", V="U(x)"), "write {U: [x]}"),
    (text(Q_x="-k*x'"), "write forces: {x: -k*x'}"),
    (text(t="10"), "write simulation: {until: 10}"),
    (text(forces="{x': -k*x'}"), "write x"),
    (text(forces="{F: -k*x'}"), "write x"),
    (text(drive="k*cos(t)"), "the key is forces; write {x: k*cos(t)}"),
    (text(find="{where: x'' = 0}"), "write name: {where: x'' = 0, for: x}"),
    (text(find="{turn: {where: x' = 0}}"), "write turn: {where: x' = 0, for: x}"),
    (text(expect="{modes: {omega: sqrt(k/m)}}"), "write [sqrt(k/m)]"),
    (text(expect="{degrees_of_freedom: one}"), "in digits"),
    (text(symmetries="{s: x -> x - eps*k, t -> t + eps}"), "write {x: -k, t: 1}"),
    (text(points="{bob: [x, 0], mass: m}"), "write bob: {position: [x, 0], mass: m}"),
    (
        text(parameters="{m: {value: [1, 2]}, k: 2}"),
        "write 1; several are run by lagcli sweep p.yaml --vary m=1,2",
    ),
    ("coordinates: [x]\nparameters: {m:}\nT: x'^2/2\n", "a blank after it"),
    (text(v0="1"), "write initial: {x': 1}"),
    (text(expect="{equations: {x: m*x'' + k*x = 0}}"), "write [m*x'' + k*x = 0]"),
    (text(expect="{equilibria: {x: 0}}"), "write [{at: {x: 0}}]"),
    (text(expect="{equilibria: [x = 0]}"), "write {at: {x: 0}}"),
    (text(expect="{equilibria: [{x: 0}]}"), "write at: {x: 0}"),
    (text(expect="{energy: true}"), "write its formula"),
    (text(points="{bob: {position: x, y}}"), "write position: [x, y]"),
    (text(parameters="{m: [kg, 1], k: 2}"), "write {value: 1, unit: kg}"),
    (text(V="x < 1 ? 0 : k*x"), "write (k*x)*(1 + sign(x - 1))/2"),
    (
        text(V="Piecewise((k*x, x < 1), (m, True))"),
        "(k*x)*(1 - sign(x - 1))/2 + m*(1 + sign(x - 1))/2",
    ),
    (text(V="If[x > 0, k x, 0]"), "write (k*x)*(1 + sign(x))/2"),
    (text(V="if x > 0 then k*x else m"), "write (k*x)*(1 + sign(x))/2 + m*(1 - sign(x))/2"),
    (text(V="m + k)*x"), "did you mean (m + k)*x?"),
    (text(V="k*(1 - cos(x"), "did you mean k*(1 - cos(x))?"),
    (text(forces="{x: k, drag: -k*x'}"), "write x: k - k*x'"),
    (text(constraints="[x - 1, x^2 == k]"), "write {c1: x - 1, c2: x^2 = k}"),
    (text(coordinates="[x, y]", forces="-k*y'"), "write {y: -k*y'}"),
    (
        "coordinates: [x]\n" + text(coordinates="[y]", T="x'^2 + y'^2"),
        "in line 1 write all as coordinates: [x, y]",
    ),
    (text(definitions="{v: [x', x]}"), "components: v_x: x', v_y: x"),
    (
        text(parameters="[m: mass, k: stiffness]"),
        "m: {description: mass}, k: {description: stiffness}",
    ),
    (text(V="k*x^2/2 + a*x + b"), "declare them: parameters: {m: 1, k: 2, g: 9.81, a, b}"),
    (text(parameters="\n  m: 1\n  k: 2", V="k*x + a*x^2"), "declare it: 'a:' below 'parameters:'"),
    (text(parameters="\n  - m", V="b*x + a"), "declare them: '- b', '- a' below 'parameters:'"),
    (text(T="(m/2)*Dt[x,t]^2"), "write (m/2)*x'^2"),
    (text(constraints="{rod: 'x^2 = k^2, N'}"), "write {equation: x^2 = k^2, multiplier: N}"),
    (text(dissipation="\n  x: -k*x'"), "write forces: {x: -k*x'}"),
    (text(brackets="[[x, p_x]]"), "write {name: [x, p_x]}"),
    (text(initial="{x: 1, x'': 0}"), "leave it out: a state has x and x'"),
    (text(parameters="{m: , k: {unit: newton per metre}}"), "write N/m"),
    (
        text(mass="2", stiffness="3"),
        "write all as parameters: {m: 1, k: 2, g: 9.81, mass: 2, stiffness: 3}",
    ),
    (text(Zwangsbedingung="{c: x = 1}"), "the key is constraints"),
    (text(definitions="a = x b = x'"), "write {a: x, b: x'}"),
    (text(charges="{p: m*x'}"), "write expect: {charges: {p: m*x'}}"),
    (text(V="U(x)"), "declare it: functions: {U: [x]}, or write its formula"),
    (text(forces="{x: F(t)}"), "declare it: functions: {F: [t]}"),
    (text(T="\"m*x'^2/2", V='k*x^2/2"'), 'write "m*x\'^2/2"'),
    ("x, y = dynamicsymbols('x y')\nm = symbols('m')\n", "lagcli new NAME"),
    (text(constraints="{x <= 1}"), "write contacts: {floor: x <= 1}"),
    (text(multiplier="N"), "write constraints: {name: {equation: left = right, multiplier: N}}"),
    (text(V="|x|*k"), "write V: abs(x)*k"),
    (text(parameters="m = 1 kg, k = 2"), "write {m: {value: 1, unit: kg}, k: 2}"),
    (text(lagrangian="T - V"), "leave out L: it is T - V"),
    (
        "Koordinaten: [x]\nKonstanten: {m: 1}\nKinetische Energie: m*x'^2/2\n",
        "the key is coordinates; in line 2 it is parameters; in line 3 it is T",
    ),
    (
        "координаты: [x]\nпараметры: {m: 1}\nT: m*x'^2/2\nначальные условия: {x: 1}\n",
        "the key is coordinates; in line 2 it is parameters; in line 4 it is initial",
    ),
    *(
        (text(coordinates="[theta]", T=f"m*{rate}^2/2", V=None), "write m*theta'^2/2")
        for rate in ("dtheta", "theta_t", "thetad", "vtheta", "dot_theta", "theta_prime")
    ),
    (text(observables="{E: energy}"), "leave it out: momenta, energy and charges are found"),
    (text(find="{w: {value: frequency}}"), "leave it out: equilibria, frequencies and charges"),
    (text(find="{w: {where: period, for: x}}"), "leave it out: equilibria, frequencies"),
    (text(parameters="{m: 1, k: {type: nonzero}}"), "the key is assume"),
    (text(constraints="{c: {equation: x = t, type: tension}}"), "the key is acts_as"),
    (text(constraints="{c: {equation: x = t, name: S}}"), "write multiplier: S"),
    (text(contacts="{c: {gap: x >= 0, force: R}}"), "write multiplier: R"),
    (text(functions="{U}", V="U(x)"), "write U: [x]"),
    (text(functions="{U: }", V="U(t)"), "write U: [t]"),
    *(
        (text(T=None) + f"{key}: m*x'^2/2\n", "did you mean 'T', with the letter Latin")
        for key in ("Τ", "Т")  # Greek and Cyrillic
    ),
    *(
        (
            text(canonical_transformations=f"{{a: {{Q: p_x, p_Q: -x, {letter}: {law}}}}}"),
            f"the key is {kind}",
        )
        for letter, law, kind in (
            ("F", "x*Q", "F1"),
            ("S", "-x*p_Q", "F2"),
            ("G", "p_x*Q", "F3"),
            ("generating", "p_x*p_Q", "F4"),
        )
    ),
    (f"{text()}---\n{text()}", "put it into a file of its own"),
    (f"{text(V=None)}---\nV: k*x^2/2\n", "leave out '---'"),
]


@pytest.mark.parametrize(("written", "hint"), HABITS)
def test_a_habit_gets_one_mistake_with_the_hint_that_helps(written, hint):
    found = messages(written)  # the others are what the first hides
    assert len(found) <= 4
    assert any(hint in each for each in found)


def test_the_line_below_a_wrong_key_is_another_mistake():
    key, rate = messages("coordinates: [x]\nparams: {m: 1}\nT: m*(dx/dt)**2/2\n")
    assert key.endswith("the key is parameters")
    assert rate.endswith("write m*x'^2/2")


@pytest.mark.parametrize("written", ["k[0]*x", "k_{0}*x"])
def test_a_name_with_an_index_is_still_to_be_declared(written):
    undeclared, foreign = sorted(messages(text(V=written)), key=lambda each: "meaning" in each)
    assert undeclared.startswith("unknown name 'k_0' in V; declare it: parameters: ")
    assert foreign.endswith("; write k_0*x")


@pytest.mark.parametrize(
    "written", ["m*x.diff(t, 2)", "m*Derivative(x, t, 2)", "m*x.diff(t).diff(t)", "m*ẍ", "m*xddot"]
)
def test_an_acceleration_in_other_words_cannot_stand_in_a_force_either(written):
    [only] = messages(text(forces=f"\n  x: {written}"))
    assert only.startswith("the acceleration x'' cannot stand in the force along 'x'")


def test_a_coordinate_that_is_missing_in_T_is_pointed_out():
    reading = read_problem("p.yaml", text(coordinates="[x, y]").encode())
    assert reading.problem is not None
    assert [each.message for each in reading.diagnostics] == [
        "the coordinate 'y' is missing in T: y' does not occur there"
    ]


@pytest.mark.parametrize(
    "even",
    ["k*abs(x')", "k*x'*sign(x')", "k*(x' - g)^2/2", "k*x'*tanh(x')", "k*log(cosh(x'))", "v^4"],
)
def test_what_an_odd_dissipation_may_be_taken_for_is_read(even):
    reading = read_problem("p.yaml", text(dissipation=even, definitions="{v: x'}").encode())
    assert reading.diagnostics == ()


@pytest.mark.parametrize(
    "kinetic",
    ["m*x'^2/2 + g*x'", "-m*sqrt(1 - x'^2)", "m*(x'^2 - k)/2", "b*x'^2/2", "-b*x'^2/2", "m*x'^2*x"],
)
def test_what_a_kinetic_energy_may_be_is_read_without_a_warning(kinetic):
    parameters = "{m, g, k, b: {assume: negative}}"
    if kinetic == "b*x'^2/2":
        assert "T is negative" in messages(text(T=kinetic, parameters=parameters))[0]
    else:
        assert messages(text(T=kinetic, parameters=parameters)) == []


@pytest.mark.first_quick
@pytest.mark.parametrize("entry", entries(), ids=lambda entry: entry.name)
def test_no_problem_of_the_library_is_warned_of(entry):
    assert read_problem(entry.name, entry.path.read_bytes()).diagnostics == ()


#: Keys of the problem, other words for them, and what is derived in any case.
SAID_OTHERWISE = {
    "brackets",
    "dimensions",
    "energy",
    "equations",
    "find",
    "forces",
    "hamiltonian",
    "lagrangian",
    "momenta",
}
SUPERSCRIPTS = "²³⁴⁵⁶⁷⁸⁹"
UNITS = ["kg", "m", "s", "N", "J", "N/m", "m/s^2", "kg*m^2", "rad"]


@pytest.mark.parametrize("seed", range(30))
def test_random_members_of_a_habit_are_hinted_alike(seed):
    draw = random.Random(seed)
    name = draw.choice(["q", "phi", "θ", "r_1", "X"])
    digit = draw.randrange(len(SUPERSCRIPTS))
    number = draw.choice(["1", "2.5", "9.81", "1e3"])
    unit = draw.choice(UNITS)
    raised = text(coordinates=f"[{name}]", T=f"m*{name}'{SUPERSCRIPTS[digit]}", V=None)
    assert messages(raised)[0].endswith(f"write m*{name}'^{digit + 2}")
    valued = text(parameters=f"{{b: {number} {unit}}}", T="x'^2/2", V=None)
    assert messages(valued) == [
        f"the unit '{unit}' cannot stand behind a number; write {{value: {number}, unit: {unit}}}"
    ]
    typed = text(coordinates=f"[{name}]", T=f"m*Derivative({name}, t)^2", V=None)
    assert messages(typed)[0].endswith(f"write m*{name}'^2")


@pytest.mark.parametrize("name", sorted({*section_names()} - SAID_OTHERWISE))
def test_a_section_as_a_key_is_an_option(name):
    [said] = messages(text(**{name: "yes"}))
    assert said.endswith(f"lagcli solve p.yaml --show {name}")


def test_sections_as_a_key_are_no_functions():
    [said] = messages(text(sections="[equilibria]"))
    assert said.endswith("lagcli solve p.yaml --show equilibria,modes")


def test_a_component_of_a_point_is_written_out():
    [said] = messages("""coordinates: [theta]
parameters: {m: {assume: positive}, l: {assume: positive}, g: {assume: positive}}
points: {bob: {mass: m, position: [l*sin(theta), -l*cos(theta)]}}
V: m*g*bob.y + m*g*bob.x^2/l
""")
    assert said.endswith("write m*g*(-l*cos(theta)) + m*g*(l*sin(theta))^2/l")


def test_a_good_file_needs_no_table_of_habits():
    for entry in list(entries())[::5]:
        habits.cache_clear()
        meanings.cache_clear()
        found = read_problem(entry.name, entry.path.read_bytes()).diagnostics
        assert not any(each.is_error for each in found)
        assert habits.cache_info().currsize == 0, entry.name
