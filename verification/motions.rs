//! Particles that follow a manufactured motion, and how far from it they end.

use crate::kept_places::Places;
use crate::mistaken_motions::Mistake;
use crate::soil::elastic_of;
use crate::water::{WaterMixture, bare, water};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, DragLaw, Material, Soil, SoilMemory, Unyielding, Water};
use alluvium::mixture::{
    ArtificialViscosity, CouplingForm, DensityDiffusion, Mixture, Phase, Source, StepError,
};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, StepSize};
use alluvium::verify::manufactured::{Both, Fields, WaterLaw, Wave, WaveOfBoth};
use alluvium::verify::{Arrangement, relative_l2};
use alluvium::{Real, SymTensor, Vector};

/// Vortices that carry a standing wave.
pub const FLOW: Wave = Wave { density: 1000.0, amplitude: 0.02, speed: 0.4, frequency: 9.0 };
pub const WATER: WaterLaw = WaterLaw { reference_density: 1000.0, sound_speed: 5.0, viscosity: 5.0 };

/// Soil and water that pass through each other.
pub const MOTION: WaveOfBoth = WaveOfBoth {
    water_density: 1000.0,
    fraction: 0.5,
    fraction_amplitude: 0.05,
    amplitude: 0.02,
    soil_speed: 0.1,
    water_speed: 0.2,
    frequency: 9.0,
    pressure: 1e3,
    shear_stress: 1.5e3,
};
pub const BOTH: Both = Both {
    water: WaterLaw { viscosity: 0.0, ..WATER },
    grain_density: 2650.0,
    bulk: 4e4,
    shear: 2e4,
    resistance: 9.81 / 0.05,
};

/// When errors are measured \[s\].
pub const END: f64 = 0.1;

/// How a motion is followed.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Particles along each edge.
    pub side: usize,
    /// h/Δx.
    pub ratio: f64,
    pub steps: usize,
    /// Out of place at the start, over the spacing.
    pub jitter: f64,
    /// How far from the origin the box begins along every axis: a whole number of periods of the motion \[m\].
    pub origin: f64,
    /// Whether gradients are corrected.
    pub corrected: bool,
    /// A mistake in the sources: to the particles the same as one in their equations.
    pub mistake: Option<Mistake>,
    /// Whether there are sources; without, the motion is its own, and costs what it costs in use.
    pub driven: bool,
    /// How places are kept from step to step.
    pub kept: Places,
}

impl Run {
    /// From the lattice, with corrected gradients, in steps that shrink with the spacing.
    pub fn new(side: usize, ratio: f64) -> Self {
        Self {
            side,
            ratio,
            steps: 3 * side,
            jitter: 0.0,
            origin: 0.0,
            corrected: true,
            mistake: None,
            driven: true,
            kept: Places::Own,
        }
    }
    /// An acceleration of soil (0) or water (1) with the mistake, if there is one.
    fn wrong<T: Real, const D: usize>(
        &self,
        right: [f64; D],
        of: usize,
        x: &[f64; D],
        t: f64,
    ) -> Vector<T, D> {
        let added = self.mistake.map_or([0.0; D], |mistake| mistake.adds(x, t)[of]);
        Vector::of(core::array::from_fn(|k| right[k] + added[k]))
    }
    /// To the end.
    fn follow<T: Real, const D: usize, S: Material<T>>(
        &self,
        mixture: Mixed<T, D, S>,
        integrator: impl Integrator<T>,
    ) -> Mixed<T, D, S> {
        self.follow_for(self.steps, mixture, integrator).expect("steps")
    }
    /// Some of the steps, if they can be done.
    pub fn follow_for<T: Real, const D: usize, S: Material<T>>(
        &self,
        steps: usize,
        mixture: Mixed<T, D, S>,
        integrator: impl Integrator<T>,
    ) -> Result<Mixed<T, D, S>, StepError> {
        let step = StepSize::fixed(T::of(END / self.steps as f64)).expect("a step");
        let mut simulation = Simulation::new(mixture, integrator, step);
        for _ in 0..steps {
            simulation.step()?;
            self.kept.keep(simulation.mixture_mut().soil_mut());
            self.kept.keep(simulation.mixture_mut().water_mut());
        }
        Ok(simulation.into_mixture())
    }
    fn places<const D: usize>(&self, seed: u64) -> Arrangement<D> {
        let mut places = Arrangement::jittered(self.side, self.jitter, seed);
        places.positions.iter_mut().flatten().for_each(|x| *x += self.origin);
        places
    }
    fn periodic<T: Real, const D: usize>(&self) -> Periodic<T, D> {
        Periodic::new(Vector::splat(T::of(self.origin)), [Some(T::ONE); D]).expect("a box")
    }
}

fn water_velocity<const D: usize>(x: &[f64; D], t: f64) -> [f64; D] {
    let fields = FLOW.at(x, t);
    core::array::from_fn(|k| fields[1 + k])
}

fn water_pressure<const D: usize>(x: &[f64; D], t: f64) -> f64 {
    WATER.pressure(FLOW.at(x, t)[0] / WATER.reference_density)
}

/// Water of [`FLOW`] at the end; `fluid` may differ from [`WATER`].
pub fn alone<T: Real, const D: usize>(
    run: Run,
    fluid: Water<T>,
    integrator: impl Integrator<T>,
) -> WaterMixture<T, D> {
    run.follow(flow(run, fluid), integrator)
}

/// The same at the start.
pub fn flow<T: Real, const D: usize>(run: Run, fluid: Water<T>) -> WaterMixture<T, D> {
    let places = run.places::<D>(1);
    let mut phase = Phase::new(fluid);
    let pressure = |x: &Vector<T, D>| T::of(water_pressure(&x.as_f64(), 0.0));
    phase.add(&places.positions(), T::of(places.volume), pressure).expect("particles");
    phase.set_velocity(|x| Vector::of(water_velocity(&x.as_f64(), 0.0)));
    let mut mixture = bare(run.ratio * places.spacing, phase).with_periodic(run.periodic());
    if run.driven {
        mixture = mixture.with_force(|x, t| Vector::of(WATER.source(&FLOW, &x.as_f64(), t)));
    }
    if run.corrected { mixture.with_gradient_correction() } else { mixture }
}

/// Relative errors of its velocity and its pressure.
pub fn errors_alone<T: Real, const D: usize>(mixture: &WaterMixture<T, D>) -> [f64; 2] {
    [
        velocity_error(mixture.water(), |x| water_velocity(x, END)),
        pressure_error(mixture.water(), |x| water_pressure(x, END)),
    ]
}

/// Velocities of a phase, particle by particle as they were added.
pub fn velocities<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> Vec<f64> {
    let mut all: Vec<_> = phase.ids().iter().zip(phase.velocities()).collect();
    all.sort_unstable_by_key(|(id, _)| **id);
    all.into_iter().flat_map(|(_, v)| v.as_f64()).collect()
}

/// The water of [`WATER`], with another viscosity.
pub fn fluid<T: Real>(viscosity: f64) -> Water<T> {
    water(WATER.sound_speed, viscosity / WATER.reference_density)
}

fn velocity_error<T: Real, const D: usize, M: Material<T>>(
    phase: &Phase<T, D, M>,
    exact: impl Fn(&[f64; D]) -> [f64; D],
) -> f64 {
    let found: Vec<f64> = phase.velocities().iter().flat_map(|v| v.as_f64()).collect();
    let exact: Vec<f64> = phase.positions().iter().flat_map(|x| exact(&x.as_f64())).collect();
    relative_l2(&found, &exact)
}

fn pressure_error<T: Real, const D: usize>(
    water: &Phase<T, D, Water<T>>,
    exact: impl Fn(&[f64; D]) -> f64,
) -> f64 {
    let found = |a| WATER.pressure(1.0 + water.compression(a).as_f64());
    let found: Vec<f64> = (0..water.len()).map(found).collect();
    let exact: Vec<f64> = water.positions().iter().map(|x| exact(&x.as_f64())).collect();
    relative_l2(&found, &exact)
}

/// Soil of the moduli of [`BOTH`].
pub fn skeleton<T: Real>() -> Soil<T, Unyielding> {
    elastic_of(BOTH.grain_density, BOTH.bulk, BOTH.shear)
}

/// Darcy's drag as in [`BOTH`], or so many times as strong.
pub fn darcy<T: Real>(strength: f64) -> Darcy<T> {
    Darcy::new(Conductivity::new(T::of(9.81 / (strength * BOTH.resistance))).expect("a conductivity"))
}

pub type Mixed<T, const D: usize, S> = Mixture<T, D, WendlandC2<T, D>, S, Water<T>>;

/// Soil and water of [`MOTION`] at the end, with a soil and a law of drag that may differ from [`BOTH`].
pub fn together<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    run: Run,
    soil: S,
    drag: impl DragLaw<T> + 'static,
    integrator: impl Integrator<T>,
) -> Mixed<T, D, S> {
    run.follow(mixed(run, soil, drag), integrator)
}

/// The same with drag solved over the step.
#[cfg(feature = "implicit")]
pub fn together_implicitly(
    run: Run,
    scheme: alluvium::mixture::DragScheme,
    integrator: impl Integrator<f64>,
) -> Mixed<f64, 2, Soil<f64, Unyielding>> {
    run.follow(mixed(run, skeleton(), darcy(1.0)).with_drag_scheme(scheme), integrator)
}

/// The root mean square of the relative errors of both velocities and of the soil's stress; then each of them, and
/// that of the pore pressure.
pub fn errors_together<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    mixture: &Mixed<T, D, S>,
) -> [f64; 5] {
    let (soil, water) = (mixture.soil(), mixture.water());
    let found: Vec<f64> = (0..soil.len()).flat_map(|i| soil.memory(i).stress.0.map(T::as_f64)).collect();
    let exact: Vec<f64> = soil.positions().iter().flat_map(|x| MOTION.stress(&x.as_f64(), END).0).collect();
    let soil = velocity_error(soil, |x| MOTION.soil_velocity(x, END));
    let pressure = pressure_error(water, |x| BOTH.pressure(&MOTION, x, END));
    let water = velocity_error(water, |x| MOTION.water_velocity(x, END));
    let stress = relative_l2(&found, &exact);
    let all = ((soil * soil + water * water + stress * stress) / 3.0).sqrt();
    [all, soil, water, stress, pressure]
}

/// The same at the start.
pub fn mixed<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    run: Run,
    soil: S,
    drag: impl DragLaw<T> + 'static,
) -> Mixed<T, D, S> {
    let places = run.places::<D>(1);
    let volume = T::of(places.volume);
    let mut soil = Phase::new(soil);
    soil.add(&places.positions(), volume, |_| T::ZERO).expect("particles");
    soil.set_volume_fraction(|x| T::of(MOTION.soil_fraction(&x.as_f64(), 0.0)));
    soil.set_velocity(|x| Vector::of(MOTION.soil_velocity(&x.as_f64(), 0.0)));
    soil.set_stress(|x| in_precision(MOTION.stress(&x.as_f64(), 0.0)));
    let mut fluid = Phase::new(fluid::<T>(0.0));
    let pressure = |x: &Vector<T, D>| T::of(BOTH.pressure(&MOTION, &x.as_f64(), 0.0));
    fluid.add(&run.places::<D>(2).positions(), volume, pressure).expect("particles");
    fluid.set_velocity(|x| Vector::of(MOTION.water_velocity(&x.as_f64(), 0.0)));
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    let kernel = WendlandC2::new(T::of(run.ratio * places.spacing)).expect("a length");
    let mixture = Mixture::new(kernel, soil, fluid)
        .with_periodic(run.periodic())
        .with_drag(drag)
        .with_artificial_viscosity(none)
        .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
        .expect("none");
    let mixture = if run.driven { driven(run, mixture) } else { mixture };
    if run.corrected {
        mixture.with_gradient_correction().with_normalised_drag()
    } else {
        mixture.with_coupling(CouplingForm::Printed)
    }
}

fn driven<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    run: Run,
    mixture: Mixed<T, D, S>,
) -> Mixed<T, D, S> {
    mixture
        .with_water_source(move |x, t| {
            let x = x.as_f64();
            let acceleration = run.wrong(BOTH.water_source(&MOTION, &x, t), 1, &x, t);
            Source { acceleration, memory: () }
        })
        .with_soil_source(move |x, t| {
            let x = x.as_f64();
            let source = BOTH.soil_source(&MOTION, &x, t);
            let memory = SoilMemory::stressed(in_precision(source.stress));
            Source { acceleration: run.wrong(source.acceleration, 0, &x, t), memory }
        })
}

fn in_precision<T: Real>(stress: SymTensor<f64>) -> SymTensor<T> {
    SymTensor(stress.0.map(T::of))
}
