"""How large a file and its formulas may be, and the sentences that say so.

Every bound of the problem format stands here, so that no text, however it is made, costs
more than a moment or can exhaust the memory or the stack.
"""

from __future__ import annotations

#: Bytes of a problem file.
FILE_BYTES = 1 << 20

#: Levels of lists and maps inside each other; the format itself needs five.
YAML_LEVELS = 40

#: Characters and nodes after every alias has been replaced by what it stands for.
EXPANDED_SIZE = 2 * FILE_BYTES

#: Characters of one expression.
EXPRESSION_CHARACTERS = 100_000

#: Parentheses, signs, powers and divisions inside each other.
NESTING_LEVELS = 200

#: Functions inside each other: a derivative of the n-th has a product of n.
CALL_LEVELS = 16

#: Exponentials inside each other, and powers with names in the exponent.
EXPONENTIAL_LEVELS = 3

#: Degree of an expression with its definitions: powers of powers, products, quotients.
DEGREE = 100_000

#: Digits of one number, with its exponent written out, and of a constant power or product.
NUMBER_DIGITS = 1_000

#: Mistakes of one file; nobody reads further ones, and they are not looked for.
MISTAKES = 200
