"""One file for each kind of claim: what it says, in numbers."""
