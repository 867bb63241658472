//! Models and polygons shared by the benchmarks.
