"""What is stated of a derivation: the records of all sections, and what a section declares."""
