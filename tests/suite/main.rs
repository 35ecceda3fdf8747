//! Integration tests, one binary.

mod neighbours;
