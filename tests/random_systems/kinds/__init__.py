"""The kinds of random systems, by name: a generator of random numbers -> a system."""

from . import constraints, forms, resting, symmetries

KINDS = constraints.KINDS | symmetries.KINDS | forms.KINDS | resting.KINDS
