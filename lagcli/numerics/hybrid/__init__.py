"""The motion piece by piece: events, contacts, impacts, friction, and the run through the modes."""
