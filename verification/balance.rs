//! What the studies of single evaluations share: fields that are random from place to place, and whether
//! the powers of all terms add up.

use alluvium::budget::{Account, Works};
use alluvium::verify::{Conditions, Random};
use alluvium::{Real, Vector};

/// A number in −1…1 that depends on every bit of the place, and on `salt`.
pub fn random<T: Real, const D: usize>(x: &Vector<T, D>, salt: u64) -> f64 {
    let bits = x.0.iter().fold(salt, |bits, x| bits.rotate_left(9) ^ x.bits());
    Random::new(bits).between(-1.0, 1.0)
}

/// Mistakes of the books: the account each leaves out, by the mutant's name.
pub type Dropped = [(&'static str, Account)];

/// |Σ| / Σ|·| of the rates of stored energy and the power of each account that is booked.
pub fn residual(stored: Vec<f64>, powers: &Works, dropped: &Dropped, conditions: &Conditions) -> f64 {
    let is_dropped = |account| dropped.iter().any(|(name, of)| *of == account && conditions.is(name));
    let booked = Account::ALL.into_iter().filter(|account| !is_dropped(*account));
    let terms: Vec<f64> = stored.into_iter().chain(booked.map(|account| powers[account])).collect();
    terms.iter().sum::<f64>().abs() / terms.iter().map(|term| term.abs()).sum::<f64>()
}
