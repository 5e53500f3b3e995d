"""The derivation in steps with their reasons, each formula taken from the derivation itself."""
