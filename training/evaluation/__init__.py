"""Measures a model on held-out duets, beside the truth and baselines."""
