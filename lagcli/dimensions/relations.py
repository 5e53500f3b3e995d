"""What is known of the unknown dimensions: linear equations, solved as they come."""

from __future__ import annotations

from fractions import Fraction

from lagcli.diagnostics import Span
from lagcli.dimensions.forms import Form, Key, minus, plus, times, unknowns


class FormRelations:
    """Equations between forms in reduced row echelon form.

    Attributes
    ----------
    origins : dict of Key to Span
        The place in the file from which each solved quantity follows.
    """

    def __init__(self) -> None:
        self._solved: dict[Key, Form] = {}  # without solved quantities on the right
        self._users: dict[Key, set[Key]] = {}  # free quantity -> the solved ones that hold it
        self.origins: dict[Key, Span] = {}

    def copied(self) -> FormRelations:
        """The same equations, to which others can be added."""
        found = FormRelations()
        found._solved = dict(self._solved)
        found._users = {key: set(users) for key, users in self._users.items()}
        found.origins = dict(self.origins)
        return found

    def reduced(self, form: Form) -> Form:
        """The form without the quantities that are solved."""
        result = form
        for key in form:
            if key in self._solved:
                exponent = form[key]
                result = plus(minus(result, {key: exponent}), self._solved[key], exponent)
        return result

    def add(self, left: Form, right: Form, origin: Span) -> bool:
        """Enter left = right; False where that contradicts what is known."""
        rest = self.reduced(minus(left, right))
        if not rest:
            return True
        free = unknowns(rest)
        if not free:
            return False
        key = free[0]
        exponent = rest[key]
        solution = times(minus(rest, {key: exponent}), Fraction(-1) / exponent)
        for user in self._users.pop(key, set()):
            held = self._solved[user]
            power = held.get(key)
            if power is not None:
                self._enter(user, plus(minus(held, {key: power}), solution, power))
        self._enter(key, solution)
        self.origins[key] = origin
        return True

    def _enter(self, key: Key, solution: Form) -> None:
        self._solved[key] = solution
        for free in unknowns(solution):
            self._users.setdefault(free, set()).add(key)

    def is_known(self, form: Form) -> bool:
        """Whether nothing unknown is left in a form."""
        return not unknowns(self.reduced(form))
