"""The training loop that all training programs share."""
