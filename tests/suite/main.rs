//! Integration tests, one binary.

#[cfg(feature = "case")]
mod case;
mod output;
