"""Hierarchical finite scalar quantisation: the autoencoder of stage 1 (paper 3.2)."""
