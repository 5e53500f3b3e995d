"""The methods: steps in doubles or with more digits, whose inside can be looked into."""
