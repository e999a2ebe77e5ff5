"""Songs: loading, the 54 features, time-stretching and synthesis."""
