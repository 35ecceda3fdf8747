//! Integration tests, one binary.

mod output;
