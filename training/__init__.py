"""Training of reactive dance models: data, HFSQ, denoiser, diffusion, metrics and the programs that run
them.
"""
