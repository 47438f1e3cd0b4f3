"""The benchmark of docs/benchmarks.md: the paper's tables from real runs, tracers beside them, sheets to look at."""
