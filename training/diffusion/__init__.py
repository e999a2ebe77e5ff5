"""Diffusion over latents (paper 3.3 to 3.5): schedule, noise, blocks, guidance, sampling, decoding."""
