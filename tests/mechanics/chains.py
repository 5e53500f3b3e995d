"""Problem files of planar chains, closed chains and pendulums in Cartesian coordinates."""

#: how the positions are written: as long sums, or each from the one before
STYLES = ("points", "definitions", "kinetic")


def chain(n, style="points"):
    """n links with masses at the joints; y points up."""
    links = range(1, n + 1)
    lines = [f"coordinates: [{', '.join(f'q{k}' for k in links)}]"]
    masses, lengths = [f"m{k}" for k in links], [f"l{k}" for k in links]
    lines.append(f"parameters: [{', '.join([*masses, *lengths, 'g'])}]")
    if style == "points":
        x = {k: " + ".join(f"l{i}*sin(q{i})" for i in range(1, k + 1)) for k in links}
        y = {k: "-" + " - ".join(f"l{i}*cos(q{i})" for i in range(1, k + 1)) for k in links}
        heights = {k: f"({y[k]})" for k in links}
    else:
        lines.append("definitions:")
        for k in links:
            x_before, y_before = (f"x{k - 1} + ", f"y{k - 1} - ") if k > 1 else ("", "-")
            lines.append(f"  x{k}: {x_before}l{k}*sin(q{k})")
            lines.append(f"  y{k}: {y_before}l{k}*cos(q{k})")
        x, y = ({k: f"{axis}{k}" for k in links} for axis in "xy")
        heights = y
    if style == "kinetic":
        lines.append("T: " + " + ".join(f"m{k}*(x{k}'^2 + y{k}'^2)/2" for k in links))
    else:
        lines.append("points:")
        lines += [f"  P{k}: {{mass: m{k}, position: ['{x[k]}', '{y[k]}']}}" for k in links]
    if style == "points":
        terms = [f"({' + '.join(masses[k - 1 :])})*l{k}*cos(q{k})" for k in links]
        lines.append(f"V: -g*({' + '.join(terms)})")
    else:
        lines.append("V: " + " + ".join(f"m{k}*g*{heights[k]}" for k in links))
    return "\n".join(lines) + "\n"


def closed(n, style="points"):
    """A chain whose end is held at (d, 0)."""
    text = chain(n, style).replace("g]", "g, d]")
    if style == "points":
        x = " + ".join(f"l{i}*sin(q{i})" for i in range(1, n + 1))
        y = " + ".join(f"l{i}*cos(q{i})" for i in range(1, n + 1))
    else:
        x, y = f"x{n}", f"y{n}"
    return text + f"constraints:\n  cx: '{x} = d'\n  cy: '{y} = 0'\n"


def cartesian(n):
    """n masses on rods, in Cartesian coordinates with one multiplier for each rod."""
    links = range(1, n + 1)
    names = [f"{axis}{k}" for k in links for axis in "xy"]
    lines = [
        f"coordinates: [{', '.join(names)}]",
        f"parameters: [{', '.join([f'm{k}' for k in links] + [f'l{k}' for k in links] + ['g'])}]",
        "T: " + " + ".join(f"m{k}*(x{k}'^2 + y{k}'^2)/2" for k in links),
        "V: " + " + ".join(f"m{k}*g*y{k}" for k in links),
        "constraints:",
    ]
    for k in links:
        x, y = (f"(x{k} - x{k - 1})", f"(y{k} - y{k - 1})") if k > 1 else ("x1", "y1")
        lines.append(f"  rod{k}: {x}^2 + {y}^2 = l{k}^2")
    return "\n".join(lines) + "\n"
