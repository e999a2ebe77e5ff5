"""Training of reactive dance models. The programs are train_hfsq, train_denoiser and generate."""
