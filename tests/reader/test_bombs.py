"""Files made to exhaust memory, stack or patience are refused, and at once."""

import pytest

from lagcli.reader import read_problem

HEAD = "coordinates: [x]\nT: x'^2\nV: "
LAUGHS = "a: &a [lol, lol, lol, lol, lol, lol, lol, lol, lol, lol]\n" + "".join(
    f"{name}: &{name} [{', '.join([f'*{before}'] * 10)}]\n"
    for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)
CHAIN = "".join(f"  p{i}: p{i + 1}\n" for i in range(10_000))

BOMBS = {
    "billion laughs": (LAUGHS, "the aliases expand to more than 2 MiB"),
    "file": ("#" * (1024 * 1024 + 1), "the limit is 1 MiB"),
    "brackets": ("[" * 100_000, "40 levels"),
    "braces": ("{a: " * 100_000, "40 levels"),
    "blocks": ("\n".join(" " * i + "a:" for i in range(1000)), "40 levels"),
    "dashes": ("- " * 100_000, "40 levels"),
    "characters": (HEAD + "1+" * 50_000 + "1", "the limit is 100,000"),
    "parentheses": (HEAD + "(" * 99_999, "200 levels"),
    "closed parentheses": (HEAD + "(" * 201 + "x" + ")" * 201, "200 levels"),
    "calls": (HEAD + "sin(" * 201 + "x" + ")" * 201, "more than 16 functions"),
    "powers": (HEAD + "x^" * 300 + "x", "200 levels"),
    "signs": (HEAD + '"' + "-" * 300 + 'x"', "200 levels"),
    "divisions": (HEAD + "x/" * 300 + "x", "200 levels"),
    "digits": (HEAD + "9" * 1001, "the limit is 1,000"),
    "exponent": (HEAD + "1e999999", "the limit is 1,000"),
    "long exponent": (HEAD + "1e" + "9" * 5000, "the limit is 1,000"),
    "negative exponent": (HEAD + "1e-999999", "the limit is 1,000"),
    "power tower": (HEAD + "9^9^9^9", "the limit is 1,000"),
    "power": (HEAD + "2^(10^9)", "the limit is 1,000"),
    "power of a power": (HEAD + "(10^1000)^1000", "the limit is 1,000"),
    "root": (HEAD + "sqrt(2)^(10^9)", "the limit is 1,000"),
    "factor": (HEAD + "(2*x)^(10^9)", "the limit is 1,000"),
    "negative power": (HEAD + "2^-1000000", "the limit is 1,000"),
    "product": (HEAD + "*".join(["10^999"] * 100), "the limit is 1,000"),
    "power in a symmetry": (
        "coordinates: [x]\nT: x'^2\nsymmetries: {s: {x: 10^4400*x}}",
        "the limit is 1,000",
    ),
    "exponent of a name": (HEAD + "x^" + "1" * 400, "the limit is 100,000"),
    "negative exponent of a name": (HEAD + "x^-" + "1" * 400, "the limit is 100,000"),
    "exponent with a large denominator": (HEAD + "x^(1/10^10)", "the limit is 100,000"),
    "exponent that is a power": (HEAD + "x^(10^400)", "the limit is 100,000"),
    "exponent beyond a double": (HEAD + "x^(10^990)", "the limit is 100,000"),
    "exponent of a sum": (HEAD + "(x + x')^(10^400)", "the limit is 100,000"),
    "exponent of a function": (HEAD + "sin(x)^(10^400)", "the limit is 100,000"),
    "exponent with a name": (HEAD + "x^(10^400*x)", "the limit is 100,000"),
    "power of powers": (HEAD + "((x^1000)^1000)^1000", "the limit is 100,000"),
    "power of a definition": (
        "coordinates: [x]\ndefinitions: {a: x^1000, b: a^1000}\nT: x'^2\nV: b",
        "the limit is 100,000",
    ),
    "exponent in a symmetry": (
        "coordinates: [x]\nT: x'^2\nsymmetries: {s: {x: x^(10^440)}}",
        "the limit is 100,000",
    ),
    "unknown names": (HEAD + "+".join(f"name{i}" for i in range(9000)), "unknown name"),
    "cycle": (f"coordinates: [x]\nT: x'^2\nparameters:\n{CHAIN}  p10000: p0\n", "needs itself"),
    "aliases to one formula": (
        f"V: &v {'x+' * 40_000}x\nl: [{', '.join(['*v'] * 10_000)}]",
        "the aliases expand",
    ),
}


@pytest.mark.parametrize("name", BOMBS)
def test_a_bomb_does_not_go_off(name):
    text, piece = BOMBS[name]
    found = read_problem("bomb.yaml", text.encode()).diagnostics
    assert any(piece in one.message + one.hint for one in found), found[:5]


FAR = {
    "parentheses": "(" * 200 + "x" + ")" * 200,
    "calls": "sin(" * 16 + "x" + ")" * 16,
    "signs": "-(" * 199 + "x" + ")" * 199,
    "powers": "x^" + "1^" * 198 + "1",
    "exponentials": "x^x^x^x + exp(exp(exp(x)))",
    "digits": "9" * 1000,
    "constant": "10^999*x",
    "sum": "+".join(["x"] * 50_000),
    "product": "*".join(["x"] * 50_000),
    "exponents": "1e999*x",
}


@pytest.mark.parametrize("name", FAR)
def test_up_to_the_limits_a_formula_is_read(name):
    reading = read_problem("far.yaml", f'{HEAD}"{FAR[name]}"'.encode())
    assert reading.diagnostics == ()
