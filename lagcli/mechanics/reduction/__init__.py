"""Reduction by cyclic coordinates, steady motions, and separation of the action."""
