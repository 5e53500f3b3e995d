"""Whether an equilibrium or a steady motion is stable: one judge for all sections."""
