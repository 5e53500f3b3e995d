"""What a section of the answers declares, and the sections by name."""
