"""Formulas as graphs in which equal parts are one node: the structure of a large system.

A tree written out grows with every use of a definition; here a definition, its
derivatives and all that repeats stand once, and each is worked out once.  Nothing is
expanded and there is no normal form: sums and products keep the parts that they were
made of, only numbers, like terms and equal factors are joined.

`nodes` has the nodes, `reading` makes them from the trees of a problem, `derivative`
differentiates, `substitution` puts in, `sharing` goes back to trees with named parts, and
`values` gives numbers.  No module here imports SymPy.

References
----------
Filliatre, Conchon, "Type-safe modular hash-consing", ML Workshop 2006.
Griewank, Walther, *Evaluating Derivatives*, 2nd ed., section 3.1 (forward mode).
"""
