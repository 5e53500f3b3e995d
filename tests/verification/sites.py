"""Changes of a sign, a factor, a term, a condition in the program: where they are, and a program with one."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Site:
    """One change: the module's file, the number of the node in it, what is done, the line."""

    file: str
    node: int
    change: str
    line: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line} {self.change}"


def changes_of(node: ast.AST) -> list[str]:
    """What can be done to a node."""
    match node:
        case ast.BinOp(op=ast.Add()):
            return ["a + b -> a - b", "a + b -> a", "a + b -> b"]
        case ast.BinOp(op=ast.Sub()):
            return ["a - b -> a + b", "a - b -> a"]
        case ast.BinOp(op=ast.Mult()):
            return ["a*b -> a", "a*b -> b"]
        case ast.BinOp(op=ast.Div()):
            return ["a/b -> a", "a/b -> a*b"]
        case ast.UnaryOp(op=ast.USub(), operand=operand) if not isinstance(operand, ast.Constant):
            return ["-a -> a"]
        case ast.Call(args=[ast.Starred(), *_]) if _name(node.func) in {"Add", "Mul"}:
            return ["the first term is dropped"]
        case ast.Call(args=[_, _, *_]) if _name(node.func) in {"Add", "Mul"}:
            return ["the first term is dropped"]
        case ast.Attribute(attr="One" | "NegativeOne" | "Half"):
            return ["S.One -> -S.One"]
        case ast.BinOp(op=ast.Pow()):
            return ["a**b -> a"]
        case ast.AugAssign(op=ast.Add() | ast.Sub()):
            return ["x += a -> x -= a"]
        case ast.Compare(ops=[op]) if type(op) in _OPPOSITE:
            return ["a condition is negated"]
        case ast.UnaryOp(op=ast.Not()):
            return ["not a -> a"]
        case ast.BoolOp():
            return ["and <-> or", "the first condition is dropped"]
    return []


_OPPOSITE: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Eq: ast.NotEq, ast.Lt: ast.GtE, ast.Gt: ast.LtE, ast.In: ast.NotIn, ast.Is: ast.IsNot,
}  # fmt: skip
_OPPOSITE |= {b: a for a, b in _OPPOSITE.items()}


def _name(node: ast.AST) -> str:
    match node:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
    return ""


def changed(node: Any, change: str) -> ast.AST:
    """The node with the change made."""
    left, right = getattr(node, "left", None), getattr(node, "right", None)
    match change:
        case "x += a -> x -= a":
            other = ast.Sub() if isinstance(node.op, ast.Add) else ast.Add()
            return ast.AugAssign(node.target, other, node.value)
        case "a + b -> a - b":
            return ast.BinOp(left, ast.Sub(), right)
        case "a - b -> a + b":
            return ast.BinOp(left, ast.Add(), right)
        case "a + b -> b" | "a*b -> b":
            return right
        case "a + b -> a" | "a - b -> a" | "a*b -> a" | "a/b -> a" | "a**b -> a":
            return left
        case "a/b -> a*b":
            return ast.BinOp(left, ast.Mult(), right)
        case "-a -> a" | "not a -> a":
            return node.operand
        case "a condition is negated":
            return ast.Compare(node.left, [_OPPOSITE[type(node.ops[0])]()], node.comparators)
        case "and <-> or":
            other = ast.Or() if isinstance(node.op, ast.And) else ast.And()
            return ast.BoolOp(other, node.values)
        case "the first condition is dropped":
            rest = node.values[1:]
            return rest[0] if len(rest) == 1 else ast.BoolOp(node.op, rest)
        case "S.One -> -S.One":
            return ast.UnaryOp(ast.USub(), node)
    return _without_first(node)


def _without_first(node: ast.Call) -> ast.Call:
    call = copy.deepcopy(node)
    first = call.args[0]
    if isinstance(first, ast.Starred):
        listed = ast.Call(ast.Name("list", ast.Load()), [first.value], [])
        rest = ast.Subscript(listed, ast.Slice(ast.Constant(1), None, None), ast.Load())
        call.args[0] = ast.Starred(rest, ast.Load())
    else:
        del call.args[0]
    return call


def sites(reached: dict[str, set[int]]) -> list[Site]:
    """Every change of a line that is reached."""
    found = []
    for file in sorted(reached):
        tree = ast.parse((ROOT / file).read_text())
        skipped = set(_of_annotations(tree))
        for number, node in enumerate(ast.walk(tree)):
            line = getattr(node, "lineno", 0)
            if line in reached[file] and id(node) not in skipped:
                found += [Site(file, number, change, line) for change in changes_of(node)]
    return found


def _of_annotations(tree: ast.AST) -> Iterator[int]:
    """Texts put together are no mathematics; neither are types."""
    for node in ast.walk(tree):
        texts = (ast.JoinedStr,)
        if isinstance(node, ast.BinOp):
            parts = list(ast.walk(node))
            if any(isinstance(p, texts) or (isinstance(p, ast.Constant) and isinstance(p.value, str))
                   for p in parts):  # fmt: skip
                yield id(node)


# -- a mutated program ------------------------------------------------------------------------


class Mutating(MetaPathFinder, Loader):
    """Imports one module with one node changed."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.module = site.file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")

    def find_spec(self, fullname: str, path: Any, target: Any = None) -> ModuleSpec | None:
        del path, target
        if fullname != self.module:
            return None
        file = str(ROOT / self.site.file)
        package = file.endswith("__init__.py")
        spec = spec_from_loader(fullname, self, origin=file, is_package=package)
        if package and spec is not None:
            spec.submodule_search_locations = [str(Path(file).parent)]
        return spec

    def exec_module(self, module: ModuleType) -> None:
        file = ROOT / self.site.file
        module.__file__ = str(file)
        tree = ast.parse(file.read_text())
        node = list(ast.walk(tree))[self.site.node]
        new = ast.copy_location(changed(copy.deepcopy(node), self.site.change), node)
        tree = ast.fix_missing_locations(_Replace(node, new).visit(tree))
        exec(compile(tree, str(file), "exec"), module.__dict__)


class _Replace(ast.NodeTransformer):
    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        return self.new if node is self.old else self.generic_visit(node)
