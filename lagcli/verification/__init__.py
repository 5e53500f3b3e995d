"""What is printed is verified from its printed form, by arithmetic that derives nothing.

A formula is printed in the grammar of the problem format, read back, and evaluated in ball
arithmetic (F. Johansson, Arb, IEEE Trans. Comput. 66 (2017) 1281) at random states that the
constraints allow, against quantities that come from the file's own L by automatic
differentiation.  Only the reader and the expression tree are shared with the derivation: no
normal form, no simplification, no elimination.
"""

from lagcli.verification.examination import REFUTED, UNDECIDED
from lagcli.verification.verify import verified

__all__ = ["REFUTED", "UNDECIDED", "verified"]
