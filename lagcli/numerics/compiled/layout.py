"""Where the loop over the steps has its numbers, and what its calls come back with.

`facts` and `counts` are single numbers, by the names in capitals.
"""

STRIDE = 44

# facts
UNTIL = 0
TOLERANCE = 1
LONGEST = 2
SPAN = 3
FLOOR = 4
H = 5
DEFECT = 6
SHORTEST = 7
ROUNDING = 8
SCALE = 9
KICK = 10
CLOCK = 11
NARROWEST = 12
FACTS = 13

# counts
N = 0
ORDER = 1
PENDING = 2
TIMES = 3
STEPS = 4
LIMIT = 5
PROBES = 6
PROBED = 7
HOLONOMIC = 8
CONSTRAINTS = 9
EXACT = 10
WATCHED = 11
BLOCKED = 12
SHORTENED = 13
NEAR = 14
TOUCHED = 15
COUNTS = 16

# what is watched: its kind, the rows of its argument and of the whole, its power, and the
# same rows in the doubles beside numbers of 80 bits
WIDTH = 6
DIVIDES = 0
GROWS = 1
FLAT = 2
HIGH = 3
JUMPS = 4
TURNS = 5

# what a call comes back with
MORE = 0
DONE = 1
STOPPED = 2
PIVOT = 3

LARGE = 1e300  # its square is no double; what is larger is no number of a motion
