"""How a formula is written: its order, its brackets and its signs, as the file has them."""
