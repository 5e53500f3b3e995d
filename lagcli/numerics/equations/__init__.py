"""The system as a graph, and as functions of numbers: M, forcing, constraints, model, start."""
