//! Clouds of particles to verify on.

use crate::error::ParameterError;
use crate::kernel::{Kernel, WendlandC2};
use crate::neighbours::{CellList, Pairs, Periodic};
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

/// Part of `h² ∇C` that a shift moves a particle by \[-\]; from about 1 on it would overshoot.
const SHIFT: f64 = 0.3;
/// Shifts until a relaxed arrangement is taken as it is.
const SHIFTS: usize = 25;

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

    /// The jittered lattice, moved until all particles have nearly the same share of the box: disorder as a
    /// flow leaves it. Each is moved down the gradient of concentration, as particles are shifted (Lind, Xu,
    /// Stansby & Rogers 2012), with the box repeating itself.
    ///
    /// # Panics
    /// `side` is below 6.
    pub fn relaxed(side: usize, fraction: f64, seed: u64) -> Self {
        assert!(side >= 6, "the support fits twice into the box");
        let mut cloud = Self::jittered(side, fraction, seed);
        let h = 1.5 * cloud.spacing;
        let kernel = WendlandC2::<f64, D>::new(h).expect("a positive length");
        let periodic = cloud.periodic::<f64>().expect("a box with an extent");
        for _ in 0..SHIFTS {
            let x: Vec<_> = cloud.positions::<f64>().iter().map(|&x| periodic.wrap(x)).collect();
            let pairs = Pairs::find(&mut CellList::default(), &x, kernel.support(), &periodic);
            let shifted = |i: usize| {
                let mut gradient = Vector::zero();
                for &j in pairs.of(i) {
                    let apart = periodic.difference(x[i], x[j as usize]);
                    gradient += apart * (cloud.volume * kernel.slope(apart.norm2()));
                }
                periodic.wrap(x[i] - gradient * (SHIFT * h * h)).0
            };
            cloud.positions = (0..x.len()).map(shifted).collect();
        }
        cloud
    }

    /// The same block at the bottom of a box that is higher by `empty` \[m\]: with a free surface on top, and,
    /// where the box repeats itself, one below.
    ///
    /// # Panics
    /// `empty` is negative or not finite.
    pub fn below_empty_space(mut self, empty: f64) -> Self {
        assert!(empty >= 0.0 && empty.is_finite(), "a height [m]");
        self.size[D - 1] += empty;
        self
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

    /// Standard deviation of `Σ V W` with the kernel of the relaxation.
    fn unevenness<const D: usize>(cloud: &Arrangement<D>) -> f64 {
        let kernel = WendlandC2::<f64, D>::new(1.5 * cloud.spacing).unwrap();
        let (x, periodic) = (cloud.positions::<f64>(), cloud.periodic().unwrap());
        let pairs = Pairs::find(&mut BruteForce::default(), &x, kernel.support(), &periodic);
        let share = |i: usize| -> f64 {
            let near = pairs.of(i).iter().map(|&j| periodic.difference(x[i], x[j as usize]));
            cloud.volume * (kernel.value(0.0) + near.map(|x| kernel.value(x.norm2())).sum::<f64>())
        };
        let shares: Vec<f64> = (0..x.len()).map(share).collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        (shares.iter().map(|s| (s - mean) * (s - mean)).sum::<f64>() / shares.len() as f64).sqrt()
    }

    #[test]
    fn relaxed_volumes_are_even_and_the_places_are_not() {
        fn check<const D: usize>(side: usize) {
            let (jittered, relaxed) =
                (Arrangement::<D>::jittered(side, 0.3, 3), Arrangement::<D>::relaxed(side, 0.3, 3));
            let (before, after) = (unevenness(&jittered), unevenness(&relaxed));
            assert!(after < 0.1 * before, "{D}D: {before} to {after}");
            assert_eq!(relaxed, Arrangement::relaxed(side, 0.3, 3));
            assert!(relaxed.positions.iter().flatten().all(|x| (0.0..1.0).contains(x)));
            // It is no lattice: its columns are not in line.
            let lattice = Arrangement::<D>::lattice(side);
            let apart = |a: &[f64; D], b: &[f64; D]| (a[0] - b[0] + 0.5).rem_euclid(1.0) - 0.5;
            let offsets = relaxed.positions.iter().zip(&lattice.positions).map(|(a, b)| apart(a, b).abs());
            let mean = offsets.sum::<f64>() / lattice.positions.len() as f64;
            assert!(mean > 0.02 * lattice.spacing, "{D}D: {mean}");
        }
        check::<2>(16);
        check::<3>(8);
    }

    #[test]
    fn nobody_is_in_the_empty_space() {
        let block = Arrangement::<2>::jittered(10, 0.2, 1).below_empty_space(0.5);
        assert_eq!(block.size, [1.0, 1.5]);
        assert!(block.positions.iter().all(|x| x[1] < 1.0));
        let near = |periodic: &Periodic<f64, 2>| {
            let pairs = Pairs::find(&mut BruteForce::default(), &block.positions(), 0.3, periodic);
            pairs.of(95).len() as f64 / pairs.of(45).len() as f64
        };
        // In the uppermost row about half of the neighbours of one in the middle; all of them without space.
        let full = Arrangement::<2>::jittered(10, 0.2, 1);
        assert!((0.4..0.75).contains(&near(&block.periodic().unwrap())));
        assert!(near(&full.periodic().unwrap()) > 0.8);
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
