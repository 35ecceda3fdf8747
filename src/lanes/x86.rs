//! SSE2, AVX2 and AVX-512 lanes.
