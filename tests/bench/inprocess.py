"""CPU seconds from a read problem to its verified accelerations: `inprocess.py FILE`."""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import sympy.physics.mechanics  # noqa: F401 - imports are no part of it

from lagcli import load
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics  # noqa: F401

problem = load(Path(sys.argv[1]))
began = time.process_time()
motion = Derivation(problem).dynamics.motion
seconds = time.process_time() - began
assert motion is not None
print(seconds)
