//! What can go wrong, with the values in it.

use core::fmt;

/// A parameter outside its allowed range.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterError {
    /// The parameter's name.
    pub name: &'static str,
    /// The value given.
    pub value: String,
    /// What is allowed.
    pub allowed: &'static str,
}

impl ParameterError {
    /// `name` was given as `value`, but only `allowed` is.
    pub fn new(name: &'static str, value: impl fmt::Display, allowed: &'static str) -> Self {
        Self { name, value: value.to_string(), allowed }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {} is not allowed: it must be {}", self.name, self.value, self.allowed)
    }
}

impl core::error::Error for ParameterError {}
