"""The physics: one file for each idea, named as a textbook's index names it."""
