"""From a trained checkpoint to the graphs, manifest and golden tensors that the browser runs."""
