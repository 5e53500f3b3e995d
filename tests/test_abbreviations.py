"""Names for what recurs in long answers: they change no value, and read back."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest

from lagcli import load
from lagcli.abbreviations import _Abbreviations, abbreviated, written_out
from lagcli.document import Equations, Paragraph
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    children,
    opposite,
    walk,
)
from lagcli.formatters import Options
from lagcli.formatters.page import to_document
from lagcli.notation.letters import names_in
from lagcli.notation.likeness import signed_key
from lagcli.pipeline import Request, derive, explain, read, render, state
from lagcli.reader import read_problem
from lagcli.record import replace
from lagcli.rewriting import expressions_in, rewritten
from lagcli.statements.answers import AccelerationsSection

from .formatters.examples import HOOP

SECTIONS = ("accelerations", "multipliers", "hamiltonian")


def answers(file, **request):
    return state(derive(load(file)), Request(sections=SECTIONS, **request))


def formulas(sections) -> list[Expression]:
    found: list[Expression] = []
    rewritten(sections, lambda node: found.append(node) or node)
    return found


def same_values(sections, others):
    """Formula by formula, at random values of all names."""
    draw = Random(1)
    pairs = list(zip(formulas(sections), formulas(others), strict=True))
    assert pairs
    for one, other in pairs:
        names = sorted({str(part) for part in walk(other) if isinstance(part, Name)})
        assert {str(part) for part in walk(one) if isinstance(part, Name)} == set(names)
        values = {name: draw.uniform(0.5, 1.5) for name in names}
        first, second = (evaluated(node, values, FUNCTIONS) for node in (one, other))
        assert first == pytest.approx(second, rel=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_what_recurs_with_the_other_sign_has_one_name(seed):
    source = Random(seed)
    names = [Name(letter) for letter in "abcdefgh"]

    def turned(node: Sum) -> Sum:
        terms = [*map(opposite, node.terms)] if source.random() < 0.5 else [*node.terms]
        return Sum(tuple(source.sample(terms, len(terms))))

    def product() -> Expression:
        whole = Product(tuple(source.sample(names, 2)))
        return Negative(whole) if source.random() < 0.5 else whole

    recurring = Sum(tuple(product() for _ in range(5)))
    shapes = [
        lambda x: Product((Name("u"), x)),
        lambda x: Quotient(Name("v"), x),
        lambda x: Power(x, Number(Fraction(source.choice((2, 3))))),
        lambda x: Call(source.choice(("sin", "cos")), (x,)),
        lambda x: Product((x, Name("w"), Power(turned(recurring), Number(Fraction(3))))),
    ]
    rows = [
        Sum(tuple(source.choice(shapes)(turned(recurring)) for _ in range(8))) for _ in range(3)
    ]
    plain = replace(
        HOOP,
        sections={
            "accelerations": AccelerationsSection(
                accelerations={str(k): row for k, row in enumerate(rows)}, verified="exact"
            )
        },
    )
    short = abbreviated(plain, ())
    kept = {str(n) for f in formulas(short.sections) for n in walk(f) if isinstance(n, Name)}
    assert kept <= {*short.where, "u", "v", "w"}
    same_values(written_out(short).sections, plain.sections)


@pytest.mark.parametrize("seed", range(6))
def test_names_follow_each_other_in_every_product_as_in_the_list(seed):
    source = Random(seed)
    sums = [
        Sum(tuple(Product((Name(a), Name(b))) for a, b in zip(row, "mnopqrsuvwxy", strict=True)))
        for row in ("abcdefghijkl", "bcdefghijkla", "cdefghijklab")
    ]
    rows = {str(k): Product(tuple(source.sample(sums, 3))) for k in range(4)}
    section = AccelerationsSection(accelerations=rows, verified="exact")
    short = abbreviated(replace(HOOP, sections={"accelerations": section}), ())
    assert len(short.where) == 3
    for row in formulas(short.sections):
        assert isinstance(row, Product)
        assert [str(factor) for factor in row.factors] == [*short.where]
    same_values(written_out(short).sections, rows)


def test_a_short_quotient_is_not_a_name_over_something():
    """H = (c r sqrt(...) - k)/r stays what it is, though the bracket occurs elsewhere."""
    letters = [Name(letter) for letter in "abcdefgh"]
    products = [Product((one, other)) for one in letters for other in letters if one != other]
    above, long = Sum(tuple(products[:5])), Sum(tuple(products))
    rows = {"short": Quotient(above, Name("v")), "u": Product((Name("u"), above)), "long": long}
    section = AccelerationsSection(accelerations=rows, verified="exact")
    short = abbreviated(replace(HOOP, sections={"accelerations": section}), ())
    assert formulas(short.sections)[0] == rows["short"]


@pytest.mark.long
@pytest.mark.parametrize(
    "file", ["problems/chains/triple-pendulum.yaml", "problems/chains/slider-crank.yaml"]
)
def test_what_is_written_out_again_is_what_was_abbreviated(file):
    plain = answers(file)
    short = abbreviated(plain, ())
    assert short.where
    assert "Delta" in short.where
    same_values(written_out(short).sections, plain.sections)


@pytest.mark.long
def test_each_name_uses_only_earlier_ones_and_is_used():
    short = answers("problems/chains/slider-crank.yaml", abbreviate=True)
    known: set[str] = set()
    for name, node in short.where.items():
        used = {p.name for p in walk(node) if isinstance(p, Name)} & short.where.keys()
        assert used <= known
        known.add(name)
    accelerations = short.sections["accelerations"].accelerations.values()
    assert all("Delta" in {p.name for p in walk(a) if isinstance(p, Name)} for a in accelerations)


@pytest.mark.long
def test_names_of_the_file_are_not_taken():
    plain = answers("problems/chains/slider-crank.yaml")
    short = abbreviated(plain, ("Delta", "k1"))
    assert not short.where.keys() & {"Delta", "k1"}
    beside_a_spring = abbreviated(plain, ("k", "l")).where
    assert not [name for name in beside_a_spring if name.startswith("k")]
    same_values(written_out(short).sections, plain.sections)


@pytest.mark.long
def test_a_short_answer_has_no_abbreviations():
    assert not answers("problems/pendulums/double-pendulum.yaml", abbreviate=True).where


@pytest.mark.long
def test_a_page_lists_the_abbreviations_that_it_uses():
    """What only JSON has, such as some matrices of a steady motion, needs none on the page."""
    text = b"""
coordinates: [x, phi]
parameters: {M: {assume: positive}, m: {assume: positive}, R: {assume: positive}, b: {assume: positive}, g: {assume: positive}, alpha: }
points:
  hub: {position: [x*cos(alpha), -x*sin(alpha)], mass: M}
  load: {position: [x*cos(alpha) + b*sin(phi), -x*sin(alpha) + b*cos(phi)], mass: m}
V: -M*g*x*sin(alpha) + m*g*(b*cos(phi) - x*sin(alpha))
constraints: {rolling: x' = R*phi'}
"""
    problem = read_problem("wheel.yaml", text).checked()
    sections = ("accelerations", "modes", "steady_motions")
    found = state(derive(problem), Request(sections=sections, abbreviate=True))
    found = replace(found, where={**found.where, "k99": Name("x")})
    listed = next(b for b in to_document(found).blocks if isinstance(b, Equations))
    rest = [b for b in to_document(found).blocks if b is not listed]
    names = [str(row.left.name) for row in listed.rows]
    assert names
    assert "k99" not in names
    read = names_in(rest) | names_in([row.right for row in listed.rows])
    assert {*names} <= read


@pytest.mark.parametrize("stiffness", ["w^2", "3*w^2"])
def test_the_time_stands_behind_the_name_of_a_frequency(stiffness):
    """sin(k2 t/(2 m)), as a charge on a spring in a magnetic field turns (Fock and Darwin)."""
    text = f"""title: t
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, w: {{assume: positive}}, q: {{assume: positive}},
  B: {{assume: positive}}}}
L: m*(x'^2 + y'^2)/2 + q*B*(x*y' - y*x')/2 - m*{stiffness}*(x^2 + y^2)/2
"""
    problem = read("t.yaml", text.encode()).problem
    request = Request(sections=("discovered",), abbreviate=True)
    told = render([state(derive(problem), request)], "text", Options())
    assert "k₂ t/(2 m)" in told
    assert "t k" not in told.replace("that k", "")


@pytest.mark.first_quick
@pytest.mark.parametrize(
    ("file", "also"),
    [
        ("particles/relativistic-coulomb", ("canonical_equations", "hamilton_jacobi")),
        ("rigid/free-asymmetric-top", ("canonical_equations",)),
        ("chains/slider-crank", ("canonical_equations",)),
    ],
)
def test_an_explanation_lists_each_name_where_it_first_occurs(file, also):
    lists, bodies = [], []
    for step in explain(derive(load(f"problems/{file}.yaml")), also).steps:
        head = step.blocks[0] if step.blocks else None
        given = isinstance(head, Paragraph) and str(head.parts[0]).startswith("With the abbrev")
        rows = step.blocks[1].rows if given else ()
        lists.append({row.left.name: names_in(row.right) for row in rows})
        bodies.append(names_in(step.blocks[2 if given else 0 :]))
    names = [name for listed in lists for name in listed]
    assert len(names) == len({*names}) > 0
    known: set[str] = set()
    for listed, body in zip(lists, bodies, strict=True):
        read = body.union(*listed.values())
        assert {*listed} <= read
        assert read & {*names} <= known | {*listed}
        known |= {*listed}
    for stem in {name.rstrip("0123456789") for name in names}:
        numbers = [int(n[len(stem) :] or 1) for n in names if n.rstrip("0123456789") == stem]
        assert numbers == sorted(numbers)


def blocks_of(file, also):
    steps = explain(derive(load(f"problems/{file}.yaml")), also).steps
    blocks = [block for step in steps for block in step.blocks if isinstance(block, Equations)]
    heads = [step.blocks[:2] for step in steps if step.blocks]
    listed = [
        rows.rows
        for lead, rows in (head for head in heads if len(head) == 2)
        if isinstance(lead, Paragraph) and str(lead.parts[0]).startswith("With the abbrev")
    ]
    return blocks, {row.left.name: row.right for rows in listed for row in rows}


@pytest.mark.long
@pytest.mark.parametrize(
    ("file", "also"),
    [
        ("oscillations/masses-joined-by-damper", ["discovered"]),
        ("nonholonomic/two-wheeled-cart", ["discovered"]),
        ("steady/rolling-hoop", ["canonical_equations"]),
        ("driven/driven-damped-oscillator", ["discovered"]),
    ],
)
def test_what_has_a_name_in_one_row_has_it_in_those_beside_it(file, also):
    """And no two names are one quantity: chi_4 and chi_8 were, of a driven oscillator."""
    blocks, named = blocks_of(file, also)
    assert named
    keys = {name: signed_key(node)[1] for name, node in named.items()}
    for block in blocks:
        trees = [tree for tree in expressions_in(block) if tree not in named.values()]
        used = set().union(*(names_in(tree) for tree in trees)) & {*named}
        parts = [signed_key(p)[1] for tree in trees for p in walk(tree) if p is not tree]
        assert not [name for name in used if keys[name] in parts]
    draw = Random(file)
    letters = {str(p) for node in named.values() for p in walk(node) if isinstance(p, Name)}
    values = {name: draw.uniform(0.5, 1.5) for name in sorted(letters - {*named})}
    sizes = []
    for name, node in named.items():
        values[name] = evaluated(node, values, FUNCTIONS)
        sizes.append(round(abs(values[name]), 9))
    assert len({*sizes}) == len(sizes)


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_part_of_a_sum_has_its_name(sign):
    """Turning points of x² w²/2 + a x³/3 + b x⁴/4: Δ + a √Δ, and a + √Δ has no name."""
    cubic = {"": "- m*a*x^3/3", "-": "+ m*a*x^3/3"}[sign]
    file = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, w: {assume: positive}, a: ,"
        f" b: {{assume: positive}}}}\nL: m*x'^2/2 - m*w^2*x^2/2 {cubic} - m*b*x^4/4"
    )
    problem = read_problem("t.yaml", file.encode()).checked()
    short = state(derive(problem), Request(sections=("reduction",), abbreviate=True))
    assert list(short.where) == ["Delta"]
    shown = render([short], "text", Options())
    assert "Δ + a √Δ" in shown
    assert shown.count("a² − 4 w² b") == 1


def test_a_short_formula_is_written_out():
    """V_eff of a governor, though a long period stands in the same section: Pars, chapter 9."""
    text = """title: t
coordinates: [theta]
parameters: {m: POSITIVE, a: POSITIVE, w: POSITIVE, k: POSITIVE, g: POSITIVE}
T: m*a^2*(theta'^2 + w^2*sin(theta)^2)
V: -2*m*g*a*cos(theta) + 2*k*a^2*(1 - cos(theta))^2
""".replace("POSITIVE", "{assume: positive}")
    request = Request(sections=("reduction",), abbreviate=True)
    found = state(derive(read("t.yaml", text.encode()).problem), request)
    assert found.where  # denominators of the periods
    potential = found.sections["reduction"].effective_potential
    assert not names_in(potential) & {*found.where}
    for point in found.sections["reduction"].one_freedom.turning_points:
        assert {n for n in names_in(point) if n in found.where} <= {"Delta"}


@pytest.mark.parametrize("taken", [{"k"}, {"xi"}, {"k", "xi"}, {"chi", "xi"}, {"k", "chi"}])
def test_names_of_denominators_are_letters(taken):
    """Of two centres in elliptic coordinates xi with k1 and k2 one was named xixi."""
    stem = _Abbreviations((), taken, changes=True)._denominators
    assert stem in {"chi", "xi", "zeta"} - taken


def test_no_factor_has_a_minus_before_every_term():
    """A bead on a parabola that spins: −ρ (Δ + 4 k² ρ'²)/Δ₂ with Δ = 2 g k − w².

    Beside the changes Δρ of symmetries, Δ is no denominator.
    """
    names = "m k w g".split()
    file = (
        f"coordinates: [rho]\nparameters: {{{', '.join(f'{n}: {{assume: positive}}' for n in names)}}}\n"
        "points: {bead: {position: [rho*cos(w*t), rho*sin(w*t), k*rho^2], mass: m}}\nV: m*g*k*rho^2"
    )
    also = "equilibria modes reduction hamilton_jacobi canonical_equations".split()
    derivation = derive(read_problem("t.yaml", file.encode()).checked())
    steps = explain(derivation, (*also,)).steps
    with_changes = explain(derivation, (*also, "discovered", "algebra")).steps
    assert not {n for n in names_in(with_changes) if n.startswith("Delta")}
    steps += with_changes
    factors = [
        factor
        for tree in expressions_in(steps)
        for part in walk(tree)
        if isinstance(part, (Product, Quotient))
        for factor in children(part)
    ]
    sums = [factor.terms for factor in factors if isinstance(factor, Sum)]
    assert sums
    assert not [terms for terms in sums if all(isinstance(term, Negative) for term in terms)]
