"""Problems as textbooks set them, each claim against brute force, some against the book's result.

G: Goldstein, Poole, Safko, 3rd ed.; LL: Landau, Lifshitz, Mechanics, 3rd ed.; T: Taylor, Classical
Mechanics; M: Morin, Introduction to Classical Mechanics; TM: Thornton, Marion, 5th ed.
"""

from __future__ import annotations

import pytest

from .run import judged
from .system import CANONICAL, MAIN, System

ALL = MAIN + CANONICAL


def posed(names, parameters, *, assume=None, conserved=None, **parts) -> System:
    """A system; parameters are positive, `conserved` says of each candidate what is known."""
    made = System(
        coordinates=dict.fromkeys(names.split()) | (assume or {}),
        parameters=dict.fromkeys(parameters.split(), "positive"),
        **{"sections": ALL, **parts},
    )
    made.known["conserved"] = conserved or {}
    return made


POLAR = {"r": "positive"}
BOOKS = {
    # constraints in differential form
    "G 1.3, disk rolling on a plane": posed(
        "x y theta phi", "m a I J", T="m*(x'^2 + y'^2)/2 + I*phi'^2/2 + J*theta'^2/2",
        constraints={"c1": "x' = a*phi'*sin(theta)", "c2": "y' = -a*phi'*cos(theta)"},
        symmetries={"turn": {"theta": "1"}, "roll": {"phi": "1"}, "right": {"x": "1"}},
        conserved={"turn": True, "roll": True, "right": False}, sections=MAIN),
    "hoop rolling down an incline, G 2.4": posed(
        "x theta", "M r g alpha", T="M*x'^2/2 + M*r^2*theta'^2/2", V="-M*g*x*sin(alpha)",
        constraints={"roll": "x' = r*theta'"}, symmetries={"slide": {"x": "r", "theta": "1"}},
        conserved={"slide": True}),
    "knife edge on an incline": posed(
        "x y phi", "m I g alpha", T="m*(x'^2 + y'^2)/2 + I*phi'^2/2", V="-m*g*x*sin(alpha)",
        constraints={"edge": "x'*sin(phi) = y'*cos(phi)"}, symmetries={"turn": {"phi": "1"}},
        conserved={"turn": True}, sections=MAIN),
    "particle with z' = y x', Rosenberg": posed(
        "x y z", "m", T="m*(x'^2 + y'^2 + z'^2)/2", constraints={"c": "z' = y*x'"},
        symmetries={"x": {"x": "1"}, "xz": {"x": "1", "z": "y"}},
        conserved={"x": False, "xz": False}, sections=MAIN),
    "Appell's constraint made linear: x' = t y'": posed(
        "x y", "m g", T="m*(x'^2 + y'^2)/2", V="m*g*y", constraints={"c": "x' = t*y'"},
        sections=MAIN),
    "turntable under a rolling ball, without spin": posed(
        "x y a b", "m R W", T="m*(x'^2 + y'^2)/2 + m*R^2*(a'^2 + b'^2)/5",
        constraints={"c1": "x' - R*b' = -W*y", "c2": "y' + R*a' = W*x"},
        symmetries={"right": {"x": "1"}}, conserved={"right": False}, sections=MAIN),
    # moving constraints and drives: h is not the energy, the energy is not conserved
    "T 7.9, bead on a rotating straight wire": posed(
        "r phi", "m w", T="m*(r'^2 + r^2*phi'^2)/2", constraints={"drive": "phi = w*t"},
        assume=POLAR, sections=MAIN),
    "G 2.7, bead on a rotating wire in its own coordinate": posed(
        "r", "m w", T="m*(r'^2 + r^2*w^2)/2", symmetries={"time": {"t": "1"}},
        conserved={"time": True}),
    "pendulum with a support that falls freely": posed(
        "theta", "m l g", points={"P": (["l*sin(theta)", "-g*t^2/2 - l*cos(theta)"], "m")},
        V="m*g*(-g*t^2/2 - l*cos(theta))", symmetries={"turn": {"theta": "1"}},
        conserved={"turn": True}),
    "LL 5.3 b, support moving sideways": posed(
        "phi", "m l g a w", points={"P": (["a*cos(w*t) + l*sin(phi)", "l*cos(phi)"], "m")},
        V="-m*g*l*cos(phi)", symmetries={"time": {"t": "1"}}, conserved={"time": False}),
    "M 6.3, spring on a uniformly accelerated cart": posed(
        "x", "m k A", T="m*(x' + A*t)^2/2", V="k*x^2/2",
        symmetries={"time": {"t": "1"}, "osc": {"x": "cos(sqrt(k/m)*t)"}},
        conserved={"time": True, "osc": True}),
    "G 8.2, cart and spring: h is conserved in the moving coordinate": posed(
        "q", "m k v l", T="m*(q' + v)^2/2", V="k*q^2/2", symmetries={"time": {"t": "1"}},
        conserved={"time": True}),
    "the same in the laboratory: h is the energy and not conserved": posed(
        "x", "m k v", T="m*x'^2/2", V="k*(x - v*t)^2/2",
        symmetries={"time": {"t": "1"}, "both": {"t": "1", "x": "v"}},
        conserved={"time": False, "both": True}),
    "string shortened through a hole at a constant rate": posed(
        "r phi", "m l b", T="m*(r'^2 + r^2*phi'^2)/2", constraints={"pull": "r = l - b*t"},
        symmetries={"turn": {"phi": "1"}}, conserved={"turn": True}, assume=POLAR, sections=MAIN),
    # boosts, dilations, gauges
    "Galilean boost of two bodies": posed(
        "x y", "m M k", T="m*x'^2/2 + M*y'^2/2", V="k*(x - y)^4",
        symmetries={"boost": {"x": "t", "y": "t"}, "one": {"x": "t"}},
        conserved={"boost": True, "one": False}),
    "boost in a uniform field": posed(
        "x z", "m g", T="m*(x'^2 + z'^2)/2", V="m*g*z",
        symmetries={"boost": {"z": "t"}, "lift": {"z": "1"},
                    "scale": {"t": "t", "x": "2*x", "z": "2*z"}},
        conserved={"boost": True, "lift": True, "scale": False}),
    "LL 10, dilation of the inverse square": posed(
        "r phi", "m k", T="m*(r'^2 + r^2*phi'^2)/2", V="k/r^2", assume=POLAR,
        symmetries={"dilation": {"t": "2*t", "r": "r"}, "conformal": {"t": "t^2", "r": "t*r"}},
        conserved={"dilation": True, "conformal": True}),
    "Kepler's third law is no symmetry of the action": posed(
        "r phi", "m k", T="m*(r'^2 + r^2*phi'^2)/2", V="-k/r", assume=POLAR,
        symmetries={"scale": {"t": "3*t", "r": "2*r"}}, conserved={"scale": False}),
    "uniform magnetic field, Landau's gauge": posed(
        "x y", "m q B", L="m*(x'^2 + y'^2)/2 + q*B*x*y'",
        symmetries={"x": {"x": "1"}, "y": {"y": "1"}, "turn": {"x": "-y", "y": "x"}},
        conserved={"x": True, "y": True, "turn": True}),
    "field of a plane wave moving along x": posed(
        "x y", "m k w a", T="m*(x'^2 + y'^2)/2", V="a*cos(k*x - w*t)",
        symmetries={"wave": {"t": "k", "x": "w"}, "time": {"t": "1"}},
        conserved={"wave": True, "time": False}),
    "LL 9.3, screw symmetry of a helix": posed(
        "r phi z", "m k h", T="m*(r'^2 + r^2*phi'^2 + z'^2)/2", V="k*r^2*cos(phi - z/h)",
        assume=POLAR, symmetries={"screw": {"phi": "1", "z": "h"}, "up": {"z": "1"}},
        conserved={"screw": True, "up": False}),
    "G 13.7, Lorentz boost of a free particle": posed(
        "x", "m c", L="-m*c^2*sqrt(1 - x'^2/c^2)", symmetries={"boost": {"t": "x/c^2", "x": "t"}},
        conserved={"boost": True}, known={"slow": "0.1"}),
    # dissipation
    "G 1.5, Rayleigh: Stokes' drag of a falling body": posed(
        "z", "m g k", T="m*z'^2/2", V="m*g*z", dissipation="k*z'^2/2",
        symmetries={"up": {"z": "1"}}, conserved={"up": False}),
    "Caldirola and Kanai's oscillator": posed(
        "x", "m w b", L="exp(2*b*t)*m*(x'^2 - w^2*x^2)/2", symmetries={"s": {"t": "1", "x": "-b*x"}},
        conserved={"s": True}),
    "dashpot between two carts": posed(
        "x y", "m M c k", T="m*x'^2/2 + M*y'^2/2", V="k*(x - y)^2/2",
        dissipation="c*(x' - y')^2/2", symmetries={"both": {"x": "1", "y": "1"},
                                                  "boost": {"x": "t", "y": "t"}},
        conserved={"both": True, "boost": True}),
    "drag that is quadratic in the speed": posed(
        "x y", "m g c", T="m*(x'^2 + y'^2)/2", V="m*g*y", dissipation="c*(x'^2 + y'^2)^(3/2)/3"),
    "gyroscopic force works nothing": posed(
        "x y", "m k b", T="m*(x'^2 + y'^2)/2", V="k*(x^2 + y^2)/2",
        forces={"x": "b*y'", "y": "-b*x'"}, symmetries={"time": {"t": "1"}},
        conserved={"time": True}),
    "a circulatory force works": posed(
        "x y", "m k b", T="m*(x'^2 + y'^2)/2", V="k*(x^2 + y^2)/2",
        forces={"x": "-b*y", "y": "b*x"}, symmetries={"time": {"t": "1"}},
        conserved={"time": False}),
    # holonomic constraints, with what they exert
    "T 7.10, block sliding on a moving wedge": posed(
        "x s", "M m g alpha", T="M*x'^2/2 + m*(x'^2 + s'^2 + 2*x'*s'*cos(alpha))/2",
        V="-m*g*s*sin(alpha)", symmetries={"push": {"x": "1"}}, conserved={"push": True}),
    "TM 7.8, bead on a cycloid": posed(
        "x y", "m g a", T="m*(x'^2 + y'^2)/2", V="m*g*y", constraints={"wire": "y = a*(1 - cos(x/a))"},
        sections=MAIN),
    "M 6.8, mass over the edge of a table": posed(
        "r phi z", "m M g l", T="m*(r'^2 + r^2*phi'^2)/2 + M*z'^2/2", V="-M*g*z", assume=POLAR,
        constraints={"string": "r + z = l"}, symmetries={"turn": {"phi": "1"}},
        conserved={"turn": True}, sections=MAIN),
    "two particles on a rod in the plane": posed(
        "x1 y1 x2 y2", "m l", T="m*(x1'^2 + y1'^2 + x2'^2 + y2'^2)/2",
        constraints={"rod": "(x1 - x2)^2 + (y1 - y2)^2 = l^2"},
        symmetries={"right": {"x1": "1", "x2": "1"},
                    "turn": {"x1": "-y1", "y1": "x1", "x2": "-y2", "y2": "x2"}},
        conserved={"right": True, "turn": True}, sections=MAIN),
    "particle on a cone, Cartesian": posed(
        "x y z", "m g a", T="m*(x'^2 + y'^2 + z'^2)/2", V="m*g*z", assume={"z": "positive"},
        constraints={"cone": "x^2 + y^2 = a^2*z^2"}, symmetries={"turn": {"x": "-y", "y": "x"}},
        conserved={"turn": True}, sections=MAIN),
    "G 1.19, spherical pendulum": posed(
        "theta phi", "m l g", T="m*l^2*(theta'^2 + sin(theta)^2*phi'^2)/2", V="m*g*l*cos(theta)",
        symmetries={"turn": {"phi": "1"}}, conserved={"turn": True}),
    "double Atwood machine": posed(
        "x y", "m1 m2 m3 g", T="m1*x'^2/2 + m2*(y' - x')^2/2 + m3*(x' + y')^2/2",
        V="-(m1*x + m2*(y - x) - m3*(x + y))*g"),
    # canonical and indirect descriptions
    "G 8.24, H of a charge by momenta": posed(
        "x y", "m q B", H="((p_x + q*B*y/2)^2 + (p_y - q*B*x/2)^2)/(2*m)",
        symmetries={"turn": {"x": "-y", "y": "x"}}, conserved={"turn": True}),
    "L with q'' removed: q q'^2/2 has other p": posed(
        "q", "a k", L="a*q'^2*q^2/2 - k*q^4/4", assume={"q": "positive"}),
    "G 2.10, generalized mechanics reduced": posed(
        "q", "m k", L="m*q'^2/2 - k*q^2/2 - m*(q'^2 + 0)/9"),
    "Toda's two particles": posed(
        "x y", "m a", T="m*(x'^2 + y'^2)/2", V="a*exp(x - y)",
        symmetries={"both": {"x": "1", "y": "1"}}, conserved={"both": True}),
    "Morse oscillator": posed("x", "m D a", T="m*x'^2/2", V="D*(1 - exp(-a*x))^2"),
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", BOOKS)
def test_every_claim_holds(name: str) -> None:
    made = BOOKS[name]
    made.seed = 3
    assert judged(made) == []
