"""What parameters and coordinates are, read from the formulas they stand in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product

from lagcli.dimensions.forms import minus
from lagcli.dimensions.inference import Inference
from lagcli.evaluation import bisected
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Call, Constant, Node, Product, Sum, Symbol, ancestry, mask_of
from lagcli.numerics.equations.jacobian import jacobian
from lagcli.numerics.equations.motion import Function
from lagcli.numerics.equations.null_space import dot, solved
from lagcli.record import record
from lagcli.studies.extremes.scene import ExtremeScene, Vector

_TRIGONOMETRIC = frozenset("sin cos tan cot sec csc".split())
_GRID = 360  # places to each half turn
_REFINED = 60
_VANISHES = 1e-9
#: An angle this near to a multiple of pi/12 is that multiple.
_NEAR, _TWELFTHS = 1e-6, 12

#: Newton's steps to a state of rest.
_ROUNDS, _AT_REST = 50, 1e-12
_MOST_FREEDOMS = 3


@record(kw_only=True)
class Angle:
    """An argument of sines that is linear in coordinates or parameters with whole factors."""

    factors: tuple[tuple[str, Fraction], ...]
    constant: Fraction


@record(kw_only=True)
class Root:
    """Where the mass matrix is singular: the coordinate, its value, and pi/12 in it."""

    coordinate: int
    value: float
    twelfths: int | None


# -- parameters ----------------------------------------------------------------------------------


def alike(scene: ExtremeScene) -> list[list[str]]:
    """Parameters by dimension: each with those that it may be compared with."""
    inference = Inference(scene.problem)
    names = inference.demands.names
    groups: list[list[str]] = []
    for name in used(scene):
        for group in groups:
            if not minus(inference.form(names[name]), inference.form(names[group[0]])):
                group.append(name)
                break
        else:
            groups.append([name])
    return groups


def used(scene: ExtremeScene) -> list[str]:
    """The parameters that the motion depends on by their size: no exponents, no whole numbers."""
    exponents: list[Node] = [
        node.arguments[1]
        for node in ancestry([scene.equations.lagrangian, *scene.dynamics])
        if isinstance(node, Call) and node.function == "^"
    ]
    angles = {name for angle in angles_of(scene) for name, _ in angle.factors}
    return [
        p.name
        for p in scene.problem.parameters
        if scene.is_in(p.name, scene.dynamics)
        and not p.integer
        and p.name not in angles
        and not scene.is_in(p.name, exponents)
        and scene.value(p.name)
    ]


# -- angles --------------------------------------------------------------------------------------


def angles_of(scene: ExtremeScene) -> list[Angle]:
    """The arguments of sines and their like, each once; multiples of one are left out."""
    e = scene.equations
    symbols: list[Symbol] = [*e.q, *(e.graph.symbol(p.name) for p in scene.problem.parameters)]
    idle = {symbol.name for symbol in scene.ignorable}
    found: dict[tuple[tuple[str, Fraction], ...], Angle] = {}
    for node in ancestry([e.lagrangian, *scene.dynamics]):
        if isinstance(node, Call) and node.function in _TRIGONOMETRIC:
            angle = _linear(scene, node.arguments[0], symbols)
            if angle is not None and not all(name in idle for name, _ in angle.factors):
                first = abs(angle.factors[0][1])
                ratio = tuple((name, k / first) for name, k in angle.factors)
                known = found.get(ratio)
                if known is None or abs(known.factors[0][1] - 1) > abs(first - 1):
                    found[ratio] = angle
    return sorted(found.values(), key=lambda angle: len(angle.factors))


def _linear(scene: ExtremeScene, argument: Node, symbols: Sequence[Symbol]) -> Angle | None:
    graph = scene.equations.graph
    factors: list[tuple[str, Fraction]] = []
    rest = argument
    for symbol in symbols:
        if symbol.mask & argument.mask:
            slope = partial(graph, symbol)(argument)
            if not isinstance(slope, Constant):
                return None
            factors.append((symbol.name, slope.value))
            rest = graph.combination([(rest, Fraction(1)), (symbol, -slope.value)])
    if not factors or not isinstance(rest, Constant):
        return None
    return Angle(factors=tuple(factors), constant=rest.value)


# -- the mass matrix -----------------------------------------------------------------------------


def singular_positions(scene: ExtremeScene) -> Iterator[Root]:
    """Where a pivot of the mass matrix vanishes as one coordinate is moved."""
    factored = scene.equations.factored
    if factored is None:
        return
    pivots = [pivot for pivot, _ in factored.pivots]
    at = scene.motion.function(pivots)
    turning = {name for angle in angles_of(scene) for name, _ in angle.factors}
    for j, symbol in enumerate(scene.equations.q):
        moving = [k for k, pivot in enumerate(pivots) if pivot.mask & symbol.mask]
        for k in moving:
            yield from _roots(scene, at, k, j, turns=symbol.name in turning)


def _roots(scene: ExtremeScene, at: Function, pivot: int, j: int, *, turns: bool) -> Iterator[Root]:
    def size(x: float) -> float:
        q = [*scene.q[:j], x, *scene.q[j + 1 :]]
        try:
            return abs(float(at(0.0, *q, *scene.v)[pivot]))
        except (ArithmeticError, ValueError):
            return math.inf

    places = [math.pi * k / _GRID for k in range(-_GRID, _GRID + 1)] if turns else [0.0]
    values = [size(x) for x in places]
    finite = [value for value in [*values, size(scene.q[j])] if value < math.inf]
    largest = max(finite, default=0.0)
    for k, x in enumerate(places):
        before, after = values[max(k - 1, 0)], values[min(k + 1, len(values) - 1)]
        if values[k] <= min(before, after) and values[k] < 0.1 * largest:
            root = _lowest(size, x, math.pi / _GRID) if turns else x
            if size(root) <= _VANISHES * largest and -math.pi < root:
                yield _snapped(j, root)


def _lowest(size: object, x: float, width: float) -> float:
    """The minimum between x - width and x + width, x itself where it is as good."""
    assert callable(size)
    low, high = x - width, x + width
    ratio = (math.sqrt(5) - 1) / 2
    for _ in range(_REFINED):
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, b) if size(a) < size(b) else (a, high)
    best = (low + high) / 2
    return x if size(x) <= size(best) else best


def _snapped(j: int, root: float) -> Root:
    twelfths = round(root * _TWELFTHS / math.pi)
    near = abs(root - twelfths * math.pi / _TWELFTHS) < _NEAR
    return Root(coordinate=j, value=root, twelfths=twelfths if near else None)


# -- states of rest ------------------------------------------------------------------------------


def unstable_rest(scene: ExtremeScene) -> Iterator[tuple[Vector, Vector, float]]:
    """Unstable equilibria: the position, the direction in which it is left, and the rate."""
    e = scene.equations
    if e.rows or scene.n > _MOST_FREEDOMS or any(node.mask & e.t.mask for node in scene.dynamics):
        return
    blocks = jacobian(scene.motion)
    seen: list[Vector] = []
    turning = {name for angle in angles_of(scene) for name, _ in angle.factors}
    choices = [
        (x,)
        if symbol in scene.ignorable
        else (0.0, math.pi, math.pi / 2, x)
        if symbol.name in turning
        else (x, 0.0, -x)
        for symbol, x in zip(e.q, scene.q, strict=True)
    ]
    for begin in product(*choices):
        q = _rest(scene, blocks, list(begin))
        if q is None or any(math.dist(q, known) < _NEAR for known in seen):
            continue
        seen.append(q)
        if any(s.name in turning and abs(x) > math.tau for s, x in zip(e.q, q, strict=True)):
            continue  # Newton's steps went whole turns away
        by_q, _ = blocks(0.0, *q, *([0.0] * scene.n))
        rate, direction = _fastest(by_q)
        if rate > 0 and not all(abs(x) > 4 for x in q):
            yield q, direction, math.sqrt(rate)


def _rest(scene: ExtremeScene, blocks: object, q: Vector) -> Vector | None:
    """A state of rest by Newton's steps, cyclic coordinates left where they are."""
    assert callable(blocks)
    zero = [0.0] * scene.n
    try:
        for _ in range(_ROUNDS):
            a = scene.motion.accelerations(0.0, *q, *zero)
            by_q, _ = blocks(0.0, *q, *zero)
            step = _solution(by_q, [-x for x in a])
            if step is None:
                return None
            q = [x + d for x, d in zip(q, step, strict=True)]
            if max(map(abs, step)) <= _AT_REST * max(1.0, *map(abs, q)):
                return q if all(math.isfinite(x) and abs(x) < 1e6 for x in q) else None
    except (ArithmeticError, ValueError):
        pass
    return None


def _solution(matrix: Sequence[Sequence[float]], right: Vector) -> Vector | None:
    """x of matrix x = right without the rows and columns that are 0."""
    n = len(right)
    kept = [j for j in range(n) if any(matrix[i][j] for i in range(n))]
    if any(right[i] for i in range(n) if i not in kept and any(matrix[i])):
        return None
    block = [[matrix[i][j] for j in kept] for i in kept]
    found = solved(block, [right[i] for i in kept])
    step = [0.0] * n
    for j, x in zip(kept, found, strict=True):
        step[j] = x
    return step


def _fastest(matrix: Sequence[Sequence[float]]) -> tuple[float, Vector]:
    """The largest real eigenvalue, by power iteration on the shifted matrix, and its vector."""
    n = len(matrix)
    shift = max(sum(map(abs, row)) for row in matrix)
    x = [1.0 + 0.1 * j for j in range(n)]
    value = 0.0
    for _ in range(2000):
        y = [shift * a + dot(row, x) for a, row in zip(x, matrix, strict=True)]
        length = math.hypot(*y)
        if not length:
            return 0.0, x
        value = length / math.hypot(*x) - shift
        x = [a / length for a in y]
    return (value if value > 1e-9 * shift else 0.0), x


# -- speeds --------------------------------------------------------------------------------------


def light_speeds(scene: ExtremeScene) -> Iterator[tuple[Vector, float]]:
    """Roots of 1 - v^2/c^2 and their like: a velocity, and the factor at which they vanish."""
    e = scene.equations
    moving = mask_of(e.qdot)
    seen: list[Vector] = []
    for node in ancestry([e.lagrangian]):
        if not isinstance(node, Product):
            continue
        for base, exponent in node.factors:
            if isinstance(base, Sum) and exponent.denominator == 2 and base.mask & moving:
                found = _ends(scene, base)
                if found is not None and found[0] not in seen:
                    seen.append(found[0])
                    yield found


def _ends(scene: ExtremeScene, radicand: Node) -> tuple[Vector, float] | None:
    """The velocity that is faster and faster, and how much faster the root allows."""
    at = scene.motion.function([radicand])
    v = list(scene.v)
    if not any(x for x, s in zip(v, scene.equations.qdot, strict=True) if s.mask & radicand.mask):
        v = [float(bool(s.mask & radicand.mask)) for s in scene.equations.qdot]

    def value(factor: float) -> float:
        return float(at(0.0, *scene.q, *(factor * x for x in v))[0])

    try:
        if not value(0.0) > 0:
            return None
        high = 1.0
        while value(high) > 0:
            high *= 2
            if high > 1e30:
                return None
        return v, bisected(lambda factor: value(factor) > 0, 0.0, high, 200)[1]
    except (ArithmeticError, ValueError):
        return None
