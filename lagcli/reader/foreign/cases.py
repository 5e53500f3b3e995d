"""A formula by cases, `a if c else b`, `c ? a : b` and `Piecewise`, as one formula with sign."""

from __future__ import annotations

import re

from lagcli.reader.regex import regex

_SIDE = r"[^<>=≤≥?,:]+?"
_RELATION = rf"(?P<left>{_SIDE})\s*(?P<sign>[<>≤≥])=?\s*(?P<right>{_SIDE})"
_FORMS = (
    rf"(?P<then>.+?)\s+(?:if|when)\s+{_RELATION}\s+else\s+(?P<other>.+)",
    rf"\(?{_RELATION}\)?\s*\?\s*(?P<then>[^?]+?)\s*:\s*(?P<other>[^?]+)",
    rf"if\s+{_RELATION}\s*:\s*(?P<then>.+?)\s*[;,]?\s*else\s*:\s*(?P<other>.+?)",
    rf"if\s+{_RELATION}\s+then\s+(?P<then>.+?)\s+else\s+(?P<other>.+?)",
    rf"(?:np\.where|where|if_else|ifelse|piecewise|If|IF)[\[(]{_RELATION},(?P<then>[^,]+),(?P<other>[^,]+)[\])]",
    rf"Piecewise\[\{{\{{(?P<then>[^,]+),{_RELATION}\}},\s*(?:\{{(?P<other>[^,]+),[^,]+\}}\}}|(?P<_>)[^,]+)\]",
    rf"(?:\w+\.)?Piecewise\(\((?P<then>[^,]+),{_RELATION}\),\s*\((?P<other>[^,]+),[^,]+\)\)",
    rf"(?P<then>.+?)\s*,?\s+(?:for|if|when)\s+{_RELATION}(?:[,;]\s*(?:else\s+)?(?P<other>0).*)?",
)
#: A group in parentheses with one more level inside.
_GROUP = regex(r"(?<!\w)\(((?:[^()]|\([^()]*\))*)\)")


def _balanced(text: str | None) -> bool:
    return text is None or text.count("(") == text.count(")")


def without_cases(text: str) -> str:
    """`(a)*(1 + sign(x))/2 + (b)*(1 - sign(x))/2` for `a if x > 0 else b`; others as they are."""
    matches = (re.fullmatch(form, text.strip()) for form in _FORMS)
    found = next((each for each in matches if each and all(map(_balanced, each.groups()))), None)
    if found is None:
        return _GROUP.sub(lambda group: f"({without_cases(group[1])})", text)
    left, right = found["left"].strip(), found["right"].strip()
    right = right if re.fullmatch(r"[\w.]+'*", right) else f"({right})"
    difference = left if right == "0" else f"{left} - {right}"
    signs = "+-" if found["sign"] in ">≥" else "-+"
    cases = zip((found["then"], found["other"] or "0"), signs, strict=True)
    terms = [(value.strip(), sign) for value, sign in cases if value.strip() not in {"0", "0.0"}]
    return " + ".join(f"({value})*(1 {sign} sign({difference}))/2" for value, sign in terms) or text
