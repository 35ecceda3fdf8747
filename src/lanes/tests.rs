//! Every operation of every lane type against the scalar one, to the bit.

use super::{InstructionSet, Lanes, Work, dispatch};
use crate::real::{Num, Real};

/// Numbers that bring out every rule: signs of zero, infinities, NaN, denormals, plain ones.
fn awkward<T: Real>() -> Vec<T> {
    let mut values = vec![0.0, -0.0, 1.0, -1.0, 1e-40, -1e-310, 1e30, -3.7, 0.1, 7.25e-4, -1e-12];
    values.extend([f64::INFINITY, f64::NEG_INFINITY, f64::NAN]);
    values.into_iter().map(T::of).collect()
}

const OPERATIONS: [&str; 11] =
    ["add", "sub", "mul", "div", "sqrt", "neg", "max", "min", "add-assign", "sub-assign", "mul-assign"];

/// All operations on all elements of `a` and `b`, and the comparison.
struct Operations<'a, T> {
    a: &'a [T],
    b: &'a [T],
}

impl<T: Real> Work<T> for Operations<'_, T> {
    type Out = (Vec<[T; OPERATIONS.len()]>, Vec<bool>);
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) -> Self::Out {
        let mut results = Vec::new();
        let mut less = Vec::new();
        for (a, b) in self.a.chunks_exact(L::WIDTH).zip(self.b.chunks_exact(L::WIDTH)) {
            // SAFETY: the chunks hold WIDTH numbers.
            let (x, y) = unsafe { (L::load(a.as_ptr()), L::load(b.as_ptr())) };
            let (mut sum, mut difference, mut product) = (x, x, x);
            sum += y;
            difference -= y;
            product *= y;
            let all =
                [x + y, x - y, x * y, x / y, x.sqrt(), -x, x.max(y), x.min(y), sum, difference, product];
            let mut stored = [[T::ZERO; 16]; OPERATIONS.len()];
            for k in 0..all.len() {
                // SAFETY: 16 numbers are room for any lanes.
                unsafe { all[k].store(stored[k].as_mut_ptr()) };
            }
            for lane in 0..L::WIDTH {
                results.push(stored.map(|row| row[lane]));
                less.push(x.less(y) >> lane & 1 == 1);
            }
            assert_eq!(u64::from(x.less(y)) >> L::WIDTH, 0, "no bits beyond the lanes");
        }
        (results, less)
    }
}

fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::NAMES.into_iter().map(|name| InstructionSet::at_most(name).unwrap())
}

fn operations_agree<T: Real>() {
    let values = awkward::<T>();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for &x in &values {
        for &y in &values {
            a.push(x);
            b.push(y);
        }
    }
    while a.len() % 16 != 0 {
        a.push(T::ONE);
        b.push(T::ONE);
    }
    let expected = dispatch(InstructionSet::at_most("scalar").unwrap(), Operations { a: &a, b: &b });
    for set in sets() {
        let found = dispatch(set, Operations { a: &a, b: &b });
        assert_eq!(found.1, expected.1, "{} {}: less", T::NAME, set.name());
        for (i, (x, y)) in found.0.iter().zip(&expected.0).enumerate() {
            for (k, name) in OPERATIONS.iter().enumerate() {
                // Which NaN an arithmetic operation returns is left open, in Rust and here.
                let exact = matches!(*name, "max" | "min" | "neg");
                let both_nan = !exact && x[k].as_f64().is_nan() && y[k].as_f64().is_nan();
                assert!(
                    both_nan || x[k].bits() == y[k].bits(),
                    "{} {}: {name}({}, {}) is {}, not {}",
                    T::NAME,
                    set.name(),
                    a[i],
                    b[i],
                    x[k],
                    y[k]
                );
            }
        }
    }
}

#[test]
fn every_operation_gives_the_scalar_bits() {
    operations_agree::<f32>();
    operations_agree::<f64>();
}

#[test]
fn max_and_min_follow_the_machine() {
    fn check<T: Real>() {
        let (zero, nan) = (T::ZERO, T::of(f64::NAN));
        // The second operand, unless the first is strictly beyond it.
        assert_eq!(Num::max(zero, -zero).bits(), (-zero).bits());
        assert_eq!(Num::max(-zero, zero).bits(), zero.bits());
        assert_eq!(Num::min(zero, -zero).bits(), (-zero).bits());
        assert_eq!(Num::max(nan, T::ONE), T::ONE);
        assert_eq!(Num::min(nan, T::ONE), T::ONE);
        assert_eq!(Num::max(T::ONE, nan).bits(), nan.bits());
        assert_eq!(Num::min(T::ONE, nan).bits(), nan.bits());
    }
    check::<f32>();
    check::<f64>();
}

struct ReadRecords<'a, T> {
    records: &'a [T],
    indices: &'a [u32],
    blocks: usize,
}

impl<T: Real> Work<T> for ReadRecords<'_, T> {
    /// The records, one after another, as read.
    type Out = Vec<T>;
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) -> Vec<T> {
        let length = 4 * self.blocks;
        let mut out = vec![T::ZERO; self.indices.len() * length];
        for (chunk, indices) in self.indices.chunks_exact(L::WIDTH).enumerate() {
            for &index in indices {
                assert!((index as usize + 1) * length <= self.records.len());
            }
            // SAFETY: WIDTH indices, and all records are there, as just asserted.
            let columns = unsafe { L::records(self.records.as_ptr(), indices.as_ptr(), self.blocks) };
            for k in 0..length {
                let mut column = [T::ZERO; 16];
                // SAFETY: 16 numbers are room for any lanes.
                unsafe { columns[k / 4][k % 4].store(column.as_mut_ptr()) };
                for lane in 0..L::WIDTH {
                    out[(chunk * L::WIDTH + lane) * length + k] = column[lane];
                }
            }
        }
        out
    }
}

fn records_agree<T: Real>() {
    let indices: Vec<u32> = (0..64).map(|i| (i * i * 7 + 3 * i) % 61).collect();
    for blocks in 1..=4 {
        // One number further than aligned: alignment is a matter of speed alone.
        let data: Vec<T> = (0..61 * 4 * blocks + 1).map(|k| T::of(k as f64 - 100.5)).collect();
        let expected: Vec<T> = indices
            .iter()
            .flat_map(|&i| data[1 + i as usize * 4 * blocks..][..4 * blocks].iter().copied())
            .collect();
        for set in sets() {
            let work = ReadRecords { records: &data[1..], indices: &indices, blocks };
            assert_eq!(dispatch(set, work), expected, "{} {} {blocks}", T::NAME, set.name());
        }
    }
}

#[test]
fn records_are_read_and_turned_round() {
    records_agree::<f32>();
    records_agree::<f64>();
}

struct Compress {
    first: u32,
}

impl<T: Real> Work<T> for Compress {
    type Out = ();
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) {
        for mask in 0..1u32 << L::WIDTH {
            let mut out = [u32::MAX; 17];
            // SAFETY: 17 integers are room for any lanes.
            let count = unsafe { L::compress(self.first, mask, out.as_mut_ptr()) };
            let mut expected = 0;
            for lane in 0..L::WIDTH as u32 {
                if mask >> lane & 1 == 1 {
                    assert_eq!(out[expected], self.first + lane);
                    expected += 1;
                }
            }
            assert_eq!(count, expected);
            assert_eq!(out[L::WIDTH], u32::MAX, "nothing beyond the lanes is touched");
        }
    }
}

#[test]
fn compress_keeps_the_lanes_of_the_mask() {
    for set in sets() {
        for first in [0, 12_345, 1 << 30] {
            dispatch::<f32, _>(set, Compress { first });
            dispatch::<f64, _>(set, Compress { first });
        }
    }
}
