"""Formulas in the notation of books and of other programs, in that of a problem file.

A formula is read as its author reads it: products without a sign, LaTeX, raised digits, the
brackets of Mathematica, the modules of Python, x(t), dx/dt, ẋ and xdot.  What may mean two things
is not translated.  Nothing is solved with it: the text goes into a hint, if the reader accepts it.
"""
