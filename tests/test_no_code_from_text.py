"""Nothing in the program turns text into code.

SymPy does it in many places: `sympify`, `parse_expr`, `S("…")`, `Symbol(…) + "…"` and every
function that accepts text for an expression evaluate that text as Python.  The calls are
found here by name; arithmetic of SymPy objects with text (implicit sympify) cannot be seen
in the source, which is why the reader alone makes expressions of text, and makes them of
plain nodes.
"""

import ast
from pathlib import Path

import pytest

import lagcli

ROOT = Path(lagcli.__file__).parent
FILES = sorted(ROOT.rglob("*.py"))

FORBIDDEN = {
    "eval", "exec", "compile", "__import__",
    "sympify", "_sympify", "parse_expr", "parse_latex", "lambdify", "autowrap", "ufuncify",
    "unsafe_load", "full_load", "literal_eval",
}  # fmt: skip

#: Calls that are dangerous by their module.
FORBIDDEN_IN = {
    "yaml": {"load", "load_all", "safe_load", "safe_load_all", "full_load"},
    "pickle": {"load", "loads", "Unpickler"},
    "marshal": {"load", "loads"},
    "shelve": {"open"},
    "subprocess": set(),
    "os": {"system", "popen"},
}

#: `re.compile` compiles a pattern, no code.
HARMLESS = {("re", "compile")}

#: Files that may run code they have generated themselves: (path, name).
#: The numbers come from straight-line code made of numbered nodes, numbered constants and
#: the words of that one module: no text of a file is ever in it.
ALLOWED: set[tuple[str, str]] = {
    ("numerics/equations/straight_line.py", "exec"),
    ("numerics/equations/straight_line.py", "compile"),
}


def forbidden_calls(tree: ast.AST) -> list[tuple[int, str]]:
    found = []
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        match node.func:
            case ast.Name(id=name) if name in FORBIDDEN:
                found.append((node.lineno, name))
            case ast.Name(id="S") if node.args and is_text(node.args[0]):
                found.append((node.lineno, "S"))
            case ast.Attribute(value=ast.Name(id=module), attr=name):
                if (module, name) in HARMLESS:
                    continue
                if name in FORBIDDEN or name in FORBIDDEN_IN.get(module, ()):
                    found.append((node.lineno, f"{module}.{name}"))
                if name == "S" and node.args and is_text(node.args[0]):
                    found.append((node.lineno, f"{module}.S"))
            case ast.Attribute(attr=name) if name in FORBIDDEN - {"compile"}:
                found.append((node.lineno, name))
    return found


def is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str)
    )


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_code_is_made_of_text(path):
    relative = path.relative_to(ROOT).as_posix()
    calls = forbidden_calls(ast.parse(path.read_text("utf-8")))
    assert [call for call in calls if (relative, call[1]) not in ALLOWED] == []


@pytest.mark.parametrize(
    "source",
    ["eval(x)", "sympy.sympify(x)", "S('x')", "sympy.S(f'{x}')", "yaml.safe_load(x)",
     "pickle.loads(x)", "a.b.lambdify(x, y)"],
)  # fmt: skip
def test_the_check_finds_what_it_looks_for(source):
    assert forbidden_calls(ast.parse(source))


def test_the_reader_imports_no_algebra():
    import subprocess
    import sys

    code = "import sys, lagcli.reader; print([m for m in ('sympy', 'numpy') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
