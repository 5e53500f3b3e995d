"""Phase space: Poisson brackets and canonical transformations."""
