"""States of rest, their stability, and the small oscillations about them."""
