"""The paper's baselines (Table 1) as small reimplementations: the essential idea of each, on this project's data."""
