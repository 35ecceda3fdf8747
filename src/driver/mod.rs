//! Drives a law without a particle: what stress follows from a path of strain, or of both.
//!
//! ```
//! use alluvium::driver::{Driver, Kind, Path};
//! use alluvium::material::{Cone, DruckerPrager, Elasticity, Soil, SoilMemory};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let sand = DruckerPrager::new(Cone::TriaxialCompression, 30_f64.to_radians(), 0.0)?;
//! let soil = Soil::new(2650.0, Elasticity::new(10e6, 0.3)?, sand)?;
//! let start = SoilMemory::geostatic(-1e5, 1.0, 2);
//! let rows = Driver::new(soil, start).run(&Path::new(Kind::TriaxialCompression, 0.05), 50)?;
//! let last = &rows[50];
//! // The plateau is that of Mohr and Coulomb, 2 sin θ / (1 − sin θ) of the lateral stress.
//! assert!((last.shear_stress() / 2e5 - 1.0).abs() < 1e-12);
//! # Ok(()) }
//! ```

mod control;
mod path;
mod row;

pub use control::DriveError;
pub use path::{Control, Kind, Leg, Path};
pub use row::Row;

use crate::material::{Loss, Material, Memory};
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// A law, and a piece of matter that obeys it.
#[derive(Clone, Debug)]
pub struct Driver<T: Real, M: Material<T>> {
    material: M,
    state: State<T, M::Memory>,
}

/// The piece of matter.
#[derive(Clone, Copy, Debug)]
struct State<T, S> {
    compression: T,
    memory: S,
    strain: SymTensor<T>,
    stress: SymTensor<T>,
    work: T,
    lost: Loss<T>,
}

/// Weights of the four evaluations of the classical Runge–Kutta method, each with the part of the
/// step at which the next one is made.
const STAGES: [(f64, f64); 4] = [(1.0 / 6.0, 0.5), (1.0 / 3.0, 0.5), (1.0 / 3.0, 1.0), (1.0 / 6.0, 0.0)];

impl<T: Real, M: Material<T>> Driver<T, M> {
    /// Matter at its reference density with this memory, at rest.
    pub fn new(material: M, memory: M::Memory) -> Self {
        let mut state = State {
            compression: T::ZERO,
            memory,
            strain: SymTensor::zero(),
            stress: SymTensor::zero(),
            work: T::ZERO,
            lost: Loss::none(),
        };
        state.stress = stress(&material, &Tensor::zero(), T::ZERO, &memory);
        Self { material, state }
    }

    /// The law.
    pub fn material(&self) -> &M {
        &self.material
    }

    /// Where it is.
    pub fn row(&self) -> Row<T, M::Memory> {
        let State { memory, strain, stress, work, lost, .. } = self.state;
        Row { strain, stress, work, lost, memory }
    }

    /// Goes along a path, each of its legs in as many increments; the rows begin with where it is.
    ///
    /// # Errors
    /// A stress asked for is not found.
    pub fn run(&mut self, path: &Path<T>, increments: usize) -> Result<Vec<Row<T, M::Memory>>, DriveError> {
        let mut rows = vec![self.row()];
        for leg in path.legs() {
            rows.extend(self.follow(&leg, increments)?);
        }
        Ok(rows)
    }

    /// Goes along one leg in equal increments; a row after each.
    ///
    /// # Errors
    /// A stress asked for is not found.
    pub fn follow(&mut self, leg: &Leg<T>, increments: usize) -> Result<Vec<Row<T, M::Memory>>, DriveError> {
        let start = self.state.stress;
        let mut guess = SymTensor::zero();
        let mut rows = Vec::with_capacity(increments);
        for k in 1..=increments {
            let target = leg.target(&start, increments, k);
            let state = self.increment(&target, &mut guess).map_err(|error| error.at(k))?;
            self.state = state;
            rows.push(self.row());
        }
        Ok(rows)
    }

    /// The state after a strain increment \[-\] and a turn (as of [`Tensor::spin`]) in `dt` \[s\].
    fn strained(&self, strain: &SymTensor<T>, turn: &[T; 3], dt: T) -> State<T, M::Memory> {
        let (law, before) = (&self.material, &self.state);
        let stretch = *strain * (T::ONE / dt);
        let gradient = gradient(&stretch, &turn.map(|angle| angle / dt));
        let mut state = *before;
        let (mut stage, mut density) = (before.memory, before.compression);
        for (weight, reach) in STAGES.map(|(weight, reach)| (T::of(weight) * dt, T::of(reach))) {
            let rate = law.rate(&gradient, &stage);
            let deviator = law.deviator(&gradient, &stage);
            let power = deviator.double_dot(&stretch) - law.pressure(density, &stage) * stretch.trace();
            state.work += power * weight;
            add(&mut state.lost, &law.power_lost(&stretch, &deviator, &stage), weight);
            state.memory = state.memory.advanced(rate, weight);
            stage = before.memory.advanced(rate, reach * dt);
            density = self.compressed(strain.trace() * reach);
        }
        let trial = stress(law, &gradient, self.compressed(strain.trace()), &state.memory);
        let (memory, taken) = law.admit(state.memory);
        add(&mut state.lost, &taken, T::ONE);
        state.memory = memory;
        state.compression = self.compressed(strain.trace());
        state.strain = before.strain + *strain;
        state.stress = stress(law, &gradient, state.compression, &memory);
        // The work is that of the admitted stress: a trial beyond it was never there.
        state.work -= (trial - state.stress).double_dot(strain) * T::of(0.5);
        state
    }

    /// The compression after a volumetric strain; none of grains.
    fn compressed(&self, volumetric: T) -> T {
        if M::RIGID_GRAINS {
            return T::ZERO;
        }
        let before = self.state.compression;
        before + (T::ONE + before) * (-volumetric).exp_m1()
    }
}

/// `−p I + τ` \[Pa\].
fn stress<T: Real, M: Material<T>>(
    law: &M,
    gradient: &Tensor<T>,
    compression: T,
    memory: &M::Memory,
) -> SymTensor<T> {
    law.deviator(gradient, memory) - SymTensor::isotropic(law.pressure(compression, memory))
}

/// The velocity gradient of a stretch and a spin.
fn gradient<T: Real>(stretch: &SymTensor<T>, spin: &[T; 3]) -> Tensor<T> {
    let ([xx, yy, zz, xy, yz, xz], [a, b, c]) = (stretch.0, *spin);
    Tensor([[xx, xy + a, xz + c], [xy - a, yy, yz + b], [xz - c, yz - b, zz]])
}

fn add<T: Real>(sum: &mut Loss<T>, loss: &Loss<T>, weight: T) {
    sum.viscous += loss.viscous * weight;
    sum.plastic += loss.plastic * weight;
    sum.scale_back += loss.scale_back * weight;
    sum.cut_off += loss.cut_off * weight;
}
