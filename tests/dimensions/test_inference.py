"""What is inferred, what is left open, and what it costs where there are no units."""

import subprocess
import sys

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import lagcli
from lagcli.diagnostics import render
from lagcli.mechanics.quantity_units import dimensions_section
from lagcli.reader import read_problem

PENDULUM = """\
coordinates:
  r: {unit: m}
  theta: {unit: rad}
parameters: [m, g, l, k, n, b]
functions: {U: [r]}
definitions: {speed: r*theta'}
T: m*(r'^2 + speed^2)/2
V: -m*g*r*cos(theta) + U(r) + k*r^n
dissipation: b*r'^2/2
constraints: {rod: r = l, turn: theta' = 0}
symmetries: {time: {t: 1}, turn: {theta: 1}, lift: {r: 1}}
"""


def section(text):
    return dimensions_section(read_problem("a.yaml", text.encode()).checked())


def render_explanation(text):
    return str(lagcli.explain(lagcli.loads(text), also=["dimensions"]))


def units(quantities):
    return {name: str(each.unit) if each.unit else None for name, each in quantities.items()}


def test_what_the_file_leaves_out_is_inferred():
    found = section(PENDULUM)
    assert units(found.coordinates) == {"r": "m", "theta": "rad"}
    assert units(found.parameters) == {
        "m": "kg", "g": "m/s^2", "l": "m", "k": None, "n": "1", "b": "kg/s"
    }  # fmt: skip
    assert found.parameters["m"].source == "inferred"
    assert found.coordinates["r"].source == "given"
    assert found.parameters["k"].source == "undetermined"
    assert units(found.functions) == {"U": "J"}
    assert units(found.definitions) == {"speed": "m/s"}
    assert str(found.energy.unit) == "J"
    assert units(found.momenta) == {"r": "kg m/s", "theta": "kg m^2/s"}
    assert units(found.forces) == {"r": "N", "theta": "N m"}
    # the force lambda df/dq is N along r; that of a velocity constraint is lambda df/dq'
    assert units(found.multipliers) == {"lambda_rod": "N", "lambda_turn": "N m"}
    assert units(found.charges) == {"time": "J", "turn": "kg m^2/s", "lift": "kg m/s"}


@pytest.mark.parametrize("mass", ["m", "1", "m/2", "m*n"])
@pytest.mark.parametrize("angle", ["rad", "1"])
def test_from_angles_alone_nothing_is_inferred_of_masses_and_lengths(mass, angle):
    """L may be an energy, one by mass (of a star), or a squared length."""
    text = (
        f"coordinates: {{r: {{}}, phi: {{unit: '{angle}'}}}}\nparameters: [m, n, w, k]\n"
        f"T: {mass}*(r'^2 + r^2*(phi' + w)^2)/2\nV: k*log(r)\nsymmetries: {{turn: {{phi: 1}}}}\n"
    )
    found = section(text)
    inferred = {*units({**found.coordinates, **found.parameters}).items()}
    assert {(name, unit) for name, unit in inferred if unit} <= {("phi", angle), ("w", "1/s")}
    assert found.energy.unit is None
    told = render_explanation(text)
    assert "The unit of" not in told
    assert "of a transformation has" not in told
    assert "[w] = 1/s" in told


@pytest.mark.parametrize(
    "lagrangian",
    ["c^2*x'^4/12 + c*x'^2*k - k^2", "c^2*x'^2 - k", "c^4*(x'^2 - k^2)/2", "c*x'^2*k - c^2*x^2"],
)
def test_l_is_no_energy_where_that_would_take_the_root_of_a_mass(lagrangian):
    """L may be the square of an energy, or an energy by mass."""
    found = section(f"coordinates: {{x: {{unit: m}}}}\nparameters: [c, k]\nL: {lagrangian}\n")
    assert found.energy.unit is None
    assert all("kg" not in (unit or "") for unit in units(found.parameters).values())


def test_a_multiplier_of_squared_lengths_is_a_force_by_a_length():
    found = section(
        "coordinates: {x: {unit: m}, y: {unit: m}}\nparameters: [m, l]\n"
        "T: m*(x'^2 + y'^2)/2\nconstraints: {rod: x^2 + y^2 = l^2}\n"
    )
    assert units(found.multipliers) == {"lambda_rod": "N/m"}


def test_other_units_than_those_of_the_si_stay():
    found = section(
        "coordinates: {x: {unit: cm}}\nparameters: {m: {unit: g}, F: {unit: dyn}}\n"
        "T: m*x'^2/2\nforces: {x: F}\nconstraints: {stop: x}\n"
    )
    assert units(found.multipliers) == {"lambda_stop": "g cm/s^2"}
    assert units(found.parameters)["F"] == "dyn"


def test_the_scale_that_derived_units_imply_is_told():
    """A file in m and dyn counts masses in 1e-5 kg."""
    found = section(
        "coordinates: {x: {unit: m}}\nparameters: {m: {}, F: {unit: dyn}}\n"
        "T: m*x'^2/2\nforces: {x: F}\n"
    )
    assert units(found.parameters)["m"] == "1e-05 kg"


def test_charges_of_gaussian_units():
    found = section(
        "coordinates: {r: {unit: cm}}\nparameters: {m: {unit: g}, q: {unit: statC}}\n"
        "T: m*r'^2/2\nV: q^2/r\n"
    )
    assert str(found.energy.unit) == "g cm^2/s^2"


@pytest.mark.parametrize(
    "text",
    [
        (
            "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, E: {unit: J}}\n"
            "T: m*x'^2/2\nV: E*log(x)\n"
        ),
        "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}}\nT: m*x'^2/2\nV: 0\n",
        "coordinates: {x: {unit: m}}\nT: x'^2/2\n",
        "coordinates: {phi: {unit: rad}}\nT: phi'^2/2\nV: -cos(phi)\n",
        (
            "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg, value: 2}, l: {unit: m, value: 1/2 + 1}}\n"
            "T: m*x'^2/2\ninitial: {x: l + 0.1, x': 3}\n"
        ),
        (
            "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, n: {}, a: {unit: m}, E: {unit: J}}\n"
            "T: m*x'^2/2\nV: E*((x/a)^n + (x/a)^(2*n))\n"
        ),
        (
            "coordinates: {x: {unit: km}}\nparameters: {m: {unit: kg}, v: {unit: km/h}}\n"
            "T: m*(x' - v)^2/2\n"
        ),
    ],
)
def test_what_is_right_is_not_refused(text):
    reading = read_problem("a.yaml", text.encode())
    assert [d.message for d in reading.diagnostics] == []


def test_an_inferred_unit_is_told_with_the_place_from_which_it_follows():
    text = (
        "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, k: {}}\n"
        "T: m*x'^2/2\nV: k*x^2/2 + k*x\n"
    )
    reading = read_problem("a.yaml", text.encode())
    shown = render(reading.source, reading.diagnostics)
    assert "a.yaml:4:14: error: 'k*x' is a force (N)" in shown
    assert "a.yaml:4:4: note: 'k' has no unit; from this it is in N/m" in shown


def test_a_lagrangian_that_is_no_energy_is_a_warning():
    text = "coordinates: {x: {unit: m}}\nL: sqrt(1 + x^2/x^2)*x'\n"
    reading = read_problem("a.yaml", text.encode())
    assert reading.problem is not None
    assert ["L is usually an energy" in d.message for d in reading.diagnostics] == [True]


def test_mixed_units_without_numbers_are_a_warning():
    text = "coordinates: {x: {unit: m}}\nparameters: {m: {unit: g}, M: {unit: kg}}\nT: (m + M)*x'^2/2\n"
    reading = read_problem("a.yaml", text.encode())
    assert reading.problem is not None
    assert [d.severity for d in reading.diagnostics] == ["warning"]


def test_nothing_is_loaded_without_units_and_no_algebra_with_them():
    code = (
        "import sys; from lagcli.reader import read_problem\n"
        "read_problem('a', b\"coordinates: [x]\\nT: x'^2\\n\").checked()\n"
        "assert not {'lagcli.units', 'lagcli.dimensions'} & sys.modules.keys()\n"
        "read_problem('a', b\"coordinates: {x: {unit: m}}\\nT: x'^2\\n\").checked()\n"
        "assert 'lagcli.dimensions' in sys.modules\n"
        "assert not {'sympy', 'flint', 'pint'} & sys.modules.keys()\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.long
def test_many_wrong_terms_are_answered_quickly_and_not_all():
    terms = " + ".join(f"m*g*x^{2 + i % 5}" for i in range(5000))
    text = (
        "coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, g: {unit: m/s^2}}\n"
        f"T: m*x'^2/2\nV: {terms}\n"
    )
    reading = read_problem("a.yaml", text.encode())
    assert reading.problem is None
    assert len(reading.diagnostics) == 5  # one for each power, not for each term


PIECES = [
    "m",
    "kg",
    "s",
    "rad",
    "x",
    "theta",
    "'",
    "^2",
    "^",
    "*",
    "/",
    "+",
    "-",
    "(",
    ")",
    "0",
    "1",
]


@pytest.mark.long
@settings(max_examples=300)
@example([(13, 0, "m"), (0, 0, "m")])
@given(
    st.lists(
        st.tuples(
            st.integers(0, len(PENDULUM)),
            st.integers(0, 4),
            st.lists(st.sampled_from(PIECES), max_size=3).map("".join),
        ),
        min_size=1,
        max_size=4,
    )
)
def test_a_changed_file_is_answered_and_never_breaks(changes):
    text = PENDULUM
    for at, length, new in changes:
        text = text[:at] + new + text[at + length :]
    reading = read_problem("a.yaml", text.encode())
    assert (reading.problem is None) == any(d.is_error for d in reading.diagnostics)
    render(reading.source, reading.diagnostics)
    if reading.problem is not None:
        dimensions_section(reading.problem)
