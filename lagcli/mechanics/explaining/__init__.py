"""The derivation told step by step, each formula taken from the derivation itself."""
