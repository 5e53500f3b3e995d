"""Steady motions as they are stated: rolling, what they do beside, whether they are stable."""
