"""The methods by name: what each is good for, and how it is made ready for a problem.

`simulate --method`, its choice `auto` and `tradeoff` know a method from here only: one that
is registered is offered by all three.  A module is imported when its method is.
"""

from __future__ import annotations

from collections.abc import Callable

from lagcli.numerics.certified.prepared import Prepared, in_doubles
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup
from lagcli.record import record

#: dop853's, whose steps err by far less than such a tolerance, and the bound with that.
_ROUNDED_853 = 1e-14


#: Makes a method ready, or says why it is not for this problem.
Prepare = Callable[[Setup, Modes], Prepared | str]


@record(kw_only=True)
class MethodEntry:
    """A method as it is known before any problem.

    Attributes
    ----------
    name
        That of `--method`.
    order
        Of its global error in the step; None where it follows from the tolerance.
    properties : tuple of str
        Out of explicit, implicit, stiff, symplectic, fixed step, smooth (needs analytic
        equations), compiled, any precision.
    reason
        What it is taken for.
    prepare : Prepare
        Makes it ready.
    """

    name: str
    order: int | None
    properties: tuple[str, ...]
    reason: str
    prepare: Prepare


def _dop853(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.dop853 import dop853

    return in_doubles(dop853, simulation, modes, _ROUNDED_853)


def _radau5(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.radau5 import radau5

    return _without_kinks(simulation) or in_doubles(radau5, simulation, modes)


def _gauss8(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.gauss8 import gauss8

    return _without_kinks(simulation) or in_doubles(gauss8, simulation, modes)


def _yoshida8(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.yoshida8 import separates, yoshida8

    if not separates(simulation.equations) or simulation.contacts:
        return "it does not separate: it needs a constant M, forces of q and t, no constraints"
    return _without_kinks(simulation) or in_doubles(yoshida8, simulation, modes)


def _without_kinks(simulation: Setup) -> str:
    return (
        "it does not stop at the zeros of switching functions (abs, sign)"
        if simulation.equations.kinks
        else ""
    )


def _taylor64(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_doubles

    return prepared_doubles(simulation, modes)


def _taylor80(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_extended

    return prepared_extended(simulation, modes)


def _taylor128(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_quadruple

    return prepared_quadruple(simulation, modes)


def _taylor(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.precise import prepared

    return prepared(simulation, modes)


METHODS: dict[str, MethodEntry] = {
    entry.name: entry
    for entry in (
        MethodEntry(
            name="dop853",
            order=8,
            properties=("explicit",),
            reason="explicit, of order 8: the cheapest that reaches the accuracy without stiffness",
            prepare=_dop853,
        ),
        MethodEntry(
            name="radau5",
            order=5,
            properties=("implicit", "stiff"),
            reason="implicit, of order 5: something dies away so quickly that explicit methods "
            "would need more steps than it costs",
            prepare=_radau5,
        ),
        MethodEntry(
            name="gauss8",
            order=8,
            properties=("implicit", "symplectic", "fixed step"),
            reason="implicit, symplectic, of order 8: keeps charges for long times",
            prepare=_gauss8,
        ),
        MethodEntry(
            name="yoshida8",
            order=8,
            properties=("explicit", "symplectic", "fixed step"),
            reason="explicit, symplectic, of order 8: keeps charges for long times",
            prepare=_yoshida8,
        ),
        MethodEntry(
            name="taylor64",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code: the cheapest of any order where it is compiled",
            prepare=_taylor64,
        ),
        MethodEntry(
            name="taylor80",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code of 80 bits: the accuracy lies within the "
            "rounding of doubles",
            prepare=_taylor80,
        ),
        MethodEntry(
            name="taylor128",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code of 128 bits: the accuracy lies within the "
            "rounding of 80 bits",
            prepare=_taylor128,
        ),
        MethodEntry(
            name="taylor",
            order=None,
            properties=("explicit", "smooth", "any precision"),
            reason="power series with more digits than doubles: the accuracy lies within their "
            "rounding",
            prepare=_taylor,
        ),
    )
}

#: What `auto` tries before all others where the motion is stiff.
STIFF = ("radau5",)
#: Its digits are as many as are needed.
MORE_DIGITS = "taylor"
#: What has more digits than doubles for a motion that turns on them, the cheaper first.
SHARPER = ("taylor128", MORE_DIGITS)
#: A tolerance at which its steps do not pass over a bend that a rounding of doubles makes.
SHARP = 1e-17
#: What `auto` tries: of each group the first that is possible, the next group where more
#: digits may reach what was not reached.
AUTO: tuple[tuple[str, ...], ...] = (
    ("taylor64", "dop853"),
    ("taylor80",),
    ("taylor128", MORE_DIGITS),
)
