//! States of matter that a law is looked at in, and how they turn.

use crate::material::{Material, Memory};
use crate::real::Real;
use crate::space::{SymTensor, Tensor};
use crate::verify::Random;

/// Angles a rotation is looked at \[°\]; 90 and 180 would not tell the sign of the spin.
pub(super) const ANGLES: [f64; 4] = [30.0, 45.0, 70.7, 135.0];
/// Planes of rotation with their axes.
pub(super) const PLANES: [(&str, Axis); 4] = [
    ("xy", Axis([0.0, 0.0, 1.0])),
    ("yz", Axis([1.0, 0.0, 0.0])),
    ("xz", Axis([0.0, 1.0, 0.0])),
    ("an oblique plane", Axis([0.36, -0.48, 0.8])),
];

/// Strains of loading, unloading and another direction \[-\].
pub(super) fn strains() -> [[f64; 6]; 3] {
    [
        [0.0, -0.1e-3, -0.4e-3, 0.1e-3, 0.0, 0.2e-3],
        [0.1e-3, 0.1e-3, 0.2e-3, -0.3e-3, 0.1e-3, 0.0],
        [-0.2e-3, 0.0, -0.1e-3, 0.0, 0.3e-3, -0.1e-3],
    ]
}

/// The axis of a rotation, of length one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis([f64; 3]);

impl Axis {
    /// The integrals of the spin (xy, yz, xz) over the rotation \[rad\].
    pub(super) fn spin(self, angle: f64) -> [f64; 3] {
        let [x, y, z] = self.0.map(|n| n * angle);
        [-z, -x, y]
    }

    /// `R t Rᵀ` of a symmetric tensor, by Rodrigues' formula.
    pub(super) fn turned(self, tensor: &[f64; 6], angle: f64) -> [f64; 6] {
        let [x, y, z] = self.0;
        let (sin, cos) = angle.sin_cos();
        let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        let rotation = |a: usize, b: usize| {
            let unit = if a == b { cos } else { 0.0 };
            unit + sin * cross[a][b] + (1.0 - cos) * self.0[a] * self.0[b]
        };
        let at = |a: usize, b: usize| tensor[SymTensor::<f64>::index(a, b)];
        let component = |a: usize, b: usize| -> f64 {
            (0..9).map(|k| rotation(a, k / 3) * at(k / 3, k % 3) * rotation(b, k % 3)).sum()
        };
        [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|(a, b)| component(a, b))
    }
}

/// `ρ̃₀ c²` \[Pa\].
pub(super) fn stiffness<T: Real, M: Material<T>>(law: &M) -> f64 {
    law.reference_density().as_f64() * law.sound_speed().as_f64().powi(2)
}

/// A memory under a pressure of a thousandth of the stiffness and little shear, if the law remembers stress.
pub(super) fn pressed<T: Real, M: Material<T>>(law: &M) -> M::Memory {
    law.admit(stressed(law)).0
}

fn stressed<T: Real, M: Material<T>>(law: &M) -> M::Memory {
    let pressure = 1e-3 * stiffness(law);
    let stress = [-1.0, -0.9, -1.1, 0.05, 0.0, -0.05].map(|part| T::of(part * pressure));
    law.with_stress(M::Memory::default(), &SymTensor(stress))
}

/// Whether a stress put into the memory is there.
pub(super) fn remembers_stress<T: Real, M: Material<T>>(law: &M) -> bool {
    stressed(law) != M::Memory::default()
}

/// Whether the pressure is below zero where the matter is expanded.
pub(super) fn bears_suction<T: Real, M: Material<T>>(law: &M) -> bool {
    law.pressure(T::of(-1e-3), &M::Memory::default()) < T::ZERO
}

/// A random velocity gradient with components up to `size` \[1/s\].
pub(super) fn gradient<T: Real>(random: &mut Random, size: f64) -> Tensor<T> {
    Tensor(core::array::from_fn(|_| core::array::from_fn(|_| T::of(size * random.between(-1.0, 1.0)))))
}

/// The memory after a second of a velocity gradient, not yet admitted.
fn strained<T: Real, M: Material<T>>(law: &M, gradient: &Tensor<T>, memory: M::Memory) -> M::Memory {
    memory.advanced(law.rate(gradient, &memory), T::ONE)
}

/// Admissible memories after a few small random strains, one of them from the very beginning.
pub(super) fn prepared<T: Real, M: Material<T>>(law: &M) -> Vec<M::Memory> {
    let mut random = Random::new(29);
    let walk = |mut memory: M::Memory, random: &mut Random| {
        for _ in 0..5 {
            memory = law.admit(strained(law, &gradient(random, 1e-4), memory)).0;
        }
        memory
    };
    let begin = law.admit(M::Memory::default()).0;
    [begin, pressed(law), pressed(law)].map(|memory| walk(memory, &mut random)).to_vec()
}

/// Admissible memories, many of them at a limit if there is one.
pub(super) fn admissible<T: Real, M: Material<T>>(law: &M) -> Vec<M::Memory> {
    trials(law).into_iter().map(|memory| law.admit(memory).0).collect()
}

/// Memories as a step leaves them, to be admitted yet: prepared ones after a random strain of up to 1 %.
pub(super) fn trials<T: Real, M: Material<T>>(law: &M) -> Vec<M::Memory> {
    let mut random = Random::new(31);
    let prepared = prepared(law);
    let trial = |k: usize| {
        let size = 10_f64.powf(random.between(-6.0, -2.0));
        strained(law, &gradient(&mut random, size), prepared[k % prepared.len()])
    };
    (0..300).map(trial).collect()
}

/// Whether admission ever changes anything.
pub(super) fn moves<T: Real, M: Material<T>>(law: &M) -> bool {
    trials(law).into_iter().any(|memory| law.admit(memory).0 != memory)
}

/// Whether anything is ever lost.
pub(super) fn loses<T: Real, M: Material<T>>(law: &M) -> bool {
    let mut random = Random::new(37);
    trials(law).into_iter().any(|memory| {
        let (admitted, loss) = law.admit(memory);
        let gradient = gradient(&mut random, 1.0);
        let deviator = law.deviator(&gradient, &admitted);
        let power = law.power_lost(&gradient.symmetric(), &deviator, &admitted);
        loss.total() != T::ZERO || power.total() != T::ZERO
    })
}
