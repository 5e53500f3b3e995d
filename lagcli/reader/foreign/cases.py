"""A formula by cases, `a if c else b`, `c ? a : b` and `Piecewise`, as one formula with sign."""

from __future__ import annotations

import re

from lagcli.reader.regex import balanced, regex

_SIDE = r"[^<>=≤≥?,:]+?"
_RELATION = rf"(?P<left>{_SIDE})\s*(?P<sign>[<>≤≥])=?\s*(?P<right>{_SIDE})"
_OTHERWISE = r"(?:\s*[;,]?\s*\b(?:else|otherwise)\b\s*[:,]?\s*(?P<other>.+))?"
_FORMS = (
    rf"(?P<then>.+?)\s+(?:if|when)\s+{_RELATION}\s+else\s+(?P<other>.+)",
    rf"\(?{_RELATION}\)?\s*\?\s*(?P<then>[^?]+?)\s*:\s*(?P<other>[^?]+)",
    rf"if\s+\(?{_RELATION}\)?\s*(?:[:,]|\s+then\b)\s*(?P<then>.+?){_OTHERWISE}",
    rf"(?:np\.where|where|if_else|ifelse|piecewise|[Ii]f|IF)[\[(]{_RELATION},(?P<then>[^,]+),(?P<other>[^,]+)[\])]",
    rf"Piecewise\[\{{\{{(?P<then>[^,]+),{_RELATION}\}},\s*(?:\{{(?P<other>[^,]+),[^,]+\}}\}}|(?P<_>)[^,]+)\]",
    rf"(?:\w+\.)?Piecewise\(\((?P<then>[^,]+),{_RELATION}\),\s*\((?P<other>[^,]+),[^,]+\)\)",
    rf"(?P<then>.+?)\s*,?\s+(?:for|if|when)\s+{_RELATION}(?:[,;]\s*(?:else\s+)?(?P<other>0).*)?",
)
_PART = r"(?:[^()<>=≤≥?,:]|\([^()<>=≤≥]*\))+?"
#: A condition as a factor: the `(x > d)` of `(x > d)*f`.
_FACTOR = regex(
    r"(?<![\w/^])(?<!/ )\((?![^()]*\b(?:if|when|for|else)\b)"
    rf"(?P<left>{_PART})\s*(?P<sign>[<>≤≥])=?\s*(?P<right>{_PART})\)"
    r"(?=\s*(?:[-+*/)]|$))"
)
#: A group in parentheses with one more level inside.
_GROUP = regex(r"(?<!\w)\(((?:[^()]|\([^()]*\))*)\)")


def without_cases(text: str) -> str:
    """`(a)*(1 + sign(x))/2 + (b)*(1 - sign(x))/2` for `a if x > 0 else b`; others as they are."""
    matches = (re.fullmatch(form, text.strip()) for form in _FORMS)
    found = next((each for each in matches if each and all(map(balanced, each.groups("")))), None)
    if found is None:
        text = _FACTOR.sub(_step, text)
        return _GROUP.sub(lambda group: f"({without_cases(group[1])})", text)
    cases = zip((found["then"], found["other"] or "0"), (1, -1), strict=True)
    terms = [(value.strip(), sign) for value, sign in cases if value.strip() not in {"0", "0.0"}]
    return " + ".join(f"({value})*{_step(found, sign)}" for value, sign in terms) or text


def _step(found: re.Match[str], sign: int = 1) -> str:
    """`(1 + sign(x - d))/2` for `x > d`; with the other sign where that is false."""
    left, right = found["left"].strip(), found["right"].strip()
    right = f"({right})" if re.search("[-+]", right) else right
    difference = left if right == "0" else f"{left} - {right}"
    mark = "+" if (sign > 0) == (found["sign"] in ">≥") else "-"
    return f"(1 {mark} sign({difference}))/2"
