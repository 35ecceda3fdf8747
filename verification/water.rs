//! What the studies of water share: mixtures without the terms a study does not ask about.

use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase};
use alluvium::neighbours::Periodic;
use alluvium::time::{Evolve, Integrator, Moment};
use alluvium::{Real, Vector};

pub type WaterMixture<T, const D: usize> = Mixture<T, D>;

/// Water of density 1000 kg/m³, with a speed of sound and a kinematic viscosity.
pub fn water<T: Real>(sound_speed: f64, kinematic_viscosity: f64) -> Water<T> {
    Water::new(T::of(1000.0), T::of(sound_speed))
        .and_then(|water| water.with_viscosity(T::of(1000.0 * kinematic_viscosity)))
        .expect("a water")
}

/// A mixture of that phase with neither artificial viscosity nor density diffusion.
pub fn bare<T: Real, const D: usize>(h: f64, phase: Phase<T, D, Water<T>>) -> WaterMixture<T, D> {
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    Mixture::of_water(WendlandC2::new(T::of(h)).expect("a length"), phase)
        .with_artificial_viscosity(none)
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
        .expect("no diffusion")
}

/// A box from the origin that repeats itself along the axes of positive length.
pub fn periodic<T: Real, const D: usize>(size: [f64; D]) -> Periodic<T, D> {
    let lengths = size.map(|length| (length > 0.0).then(|| T::of(length)));
    Periodic::new(Vector::zero(), lengths).expect("positive lengths")
}

/// A mistake: leap-frog whose rates see the fields of half a step ago.
#[derive(Clone, Copy, Debug)]
pub struct Unpredicted;

impl<T: Real> Integrator<T> for Unpredicted {
    fn name(&self) -> &'static str {
        "leap-frog without the half-step approximation"
    }
    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        system.evaluate()?;
        system.advance(Moment::Half, Moment::Half, dt);
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, T::ZERO);
        Ok(())
    }
}

/// A mistake: velocity-Verlet that evaluates the second rates with the fields of the start.
#[derive(Clone, Copy, Debug)]
pub struct Unforeseen;

impl<T: Real> Integrator<T> for Unforeseen {
    fn name(&self) -> &'static str {
        "velocity-verlet without a prediction"
    }
    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        let half = T::of(0.5) * dt;
        system.evaluate()?;
        system.advance(Moment::Half, Moment::Now, half);
        system.drift(Moment::Half, dt);
        system.evaluate()?;
        system.advance(Moment::Now, Moment::Half, half);
        Ok(())
    }
}
