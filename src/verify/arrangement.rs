//! Clouds of particles to verify on.

use crate::error::ParameterError;
use crate::neighbours::Periodic;
use crate::real::Real;
use crate::space::Vector;

/// Numbers that look random and are the same everywhere: SplitMix64 (Steele, Lea & Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }
    /// The next 64 bits.
    pub fn next_bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number in \[low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next_bits() >> 11) as f64 * (0.5_f64).powi(53)
    }
}

/// Places in a box that starts at the origin, in double precision.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrangement<const D: usize> {
    /// Where the particles are \[m\].
    pub positions: Vec<[f64; D]>,
    /// Distance of nearest neighbours before any jitter \[m\].
    pub spacing: f64,
    /// Volume of one particle \[m³\] (\[m²\] in 2D).
    pub volume: f64,
    /// Edges of the box \[m\].
    pub size: [f64; D],
}

impl<const D: usize> Arrangement<D> {
    /// A square or cubic lattice of `side` particles along each edge of the unit box.
    pub fn lattice(side: usize) -> Self {
        let spacing = 1.0 / side as f64;
        let place = |mut index: usize| {
            core::array::from_fn(|_| {
                let k = index % side;
                index /= side;
                (k as f64 + 0.5) * spacing
            })
        };
        Self {
            positions: (0..side.pow(D as u32)).map(place).collect(),
            spacing,
            volume: spacing.powi(D as i32),
            size: [1.0; D],
        }
    }

    /// The lattice, each coordinate moved by up to `fraction` spacings either way, uniformly.
    pub fn jittered(side: usize, fraction: f64, seed: u64) -> Self {
        let mut lattice = Self::lattice(side);
        let mut random = Random::new(seed);
        for x in lattice.positions.iter_mut().flatten() {
            *x += lattice.spacing * random.between(-fraction, fraction);
        }
        lattice
    }

    /// The positions in a precision, inside the box.
    pub fn positions<T: Real>(&self) -> Vec<Vector<T, D>> {
        self.positions.iter().map(|&x| Vector::of(x)).collect()
    }

    /// The box, repeating itself in all directions.
    ///
    /// # Errors
    /// The box has no extent.
    pub fn periodic<T: Real>(&self) -> Result<Periodic<T, D>, ParameterError> {
        Periodic::new(Vector::zero(), self.size.map(|length| Some(T::of(length))))
    }
}

impl Arrangement<2> {
    /// A hexagonal lattice: `columns` particles in each of `2 · double_rows` rows. The box is
    /// 1 wide and as high as the rows are, so that it may repeat itself.
    pub fn hexagonal(columns: usize, double_rows: usize) -> Self {
        let spacing = 1.0 / columns as f64;
        let height = spacing * 0.75_f64.sqrt();
        let place = |index: usize| {
            let (column, row) = (index % columns, index / columns);
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            [(column as f64 + shift) * spacing, (row as f64 + 0.5) * height]
        };
        Self {
            positions: (0..2 * double_rows * columns).map(place).collect(),
            spacing,
            volume: spacing * height,
            size: [1.0, 2.0 * double_rows as f64 * height],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::neighbours::{BruteForce, Pairs};

    #[test]
    fn the_sequence_is_that_of_the_paper() {
        // First outputs of the reference implementation for seed 1234567.
        let mut random = Random::new(1_234_567);
        assert_eq!(random.next_bits(), 6_457_827_717_110_365_317);
        assert_eq!(random.next_bits(), 3_203_168_211_198_807_973);
        let mean = (0..10_000).map(|_| random.between(-1.0, 3.0)).sum::<f64>() / 1e4;
        assert!((mean - 1.0).abs() < 0.05);
    }

    #[test]
    fn arrangements_fill_their_box() {
        let jittered = Arrangement::<3>::jittered(5, 0.3, 1);
        let hexagonal = Arrangement::hexagonal(8, 4);
        assert!((jittered.volume * 125.0 - 1.0).abs() < 1e-14);
        assert!((hexagonal.volume * 64.0 - hexagonal.size[1]).abs() < 1e-14);
        assert!(jittered.positions.iter().flatten().all(|x| (0.0..1.0).contains(x)));
        assert_eq!(jittered, Arrangement::jittered(5, 0.3, 1));
        assert_ne!(jittered, Arrangement::jittered(5, 0.3, 2));
    }

    #[test]
    fn six_neighbours_are_equally_near_in_a_hexagonal_lattice() {
        let hexagonal = Arrangement::hexagonal(6, 3);
        let near = |radius| {
            let x = hexagonal.positions::<f64>();
            Pairs::find(&mut BruteForce::default(), &x, radius, &hexagonal.periodic().unwrap())
        };
        let (inside, outside) = (near(hexagonal.spacing * 0.999), near(hexagonal.spacing * 1.001));
        assert_eq!((inside.count(), outside.count()), (0, 36 * 6));
    }
}
