"""Every term of a problem checked for its dimension, missing units inferred.

A dimension is a vector of rational exponents.  A quantity without a unit has unknown ones,
and every sum, equation and function of the file is a linear equation between them, the same
for each base unit: one elimination over the rationals decides them all.
"""
