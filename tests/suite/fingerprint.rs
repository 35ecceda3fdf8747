//! Every bit of a state in one number, to tell two apart.

use alluvium::Real;
use alluvium::kernel::Kernel;
use alluvium::material::{Material, Memory};
use alluvium::mixture::{Mixture, Phase};

/// Of soil and water: ids, positions, velocities, densities, volume fractions, and what laws remember.
pub fn hash<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    let bits = bits(mixture.soil()).into_iter().chain(bits(mixture.water()));
    bits.fold(start, |hash: u64, bits| (hash ^ bits).wrapping_mul(0x0100_0000_01b3).rotate_left(23))
}

fn bits<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> Vec<u64> {
    let mut bits = Vec::new();
    for i in 0..phase.len() {
        bits.push(u64::from(phase.ids()[i]));
        let vectors = [phase.positions()[i], phase.velocities()[i]];
        bits.extend(vectors.iter().flat_map(|x| x.0).map(Real::bits));
        bits.extend([phase.compression(i), phase.density(i), phase.volume_fraction(i)].map(Real::bits));
        let mut remembered = Vec::new();
        phase.memory(i).show(&mut remembered);
        bits.extend(remembered.into_iter().map(f64::to_bits));
    }
    bits
}
