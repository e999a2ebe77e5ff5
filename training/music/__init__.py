"""Songs: loading, the 54 features, tempo, synthesis and pairing with dances."""
