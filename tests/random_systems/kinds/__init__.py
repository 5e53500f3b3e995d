"""The kinds of random systems, by name: a generator of random numbers -> a system."""

from . import constraints, forms, further, resting, symmetries

KINDS = constraints.KINDS | symmetries.KINDS | forms.KINDS | resting.KINDS | further.KINDS
