"""The stage-2 network: condition encoder, coarse trunk and fine heads (paper 3.3)."""
