"""Studies of many problems or many runs."""
