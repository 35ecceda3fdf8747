//! Clouds of water, soil or both, seen from one frame or another, followed for some steps and read particle by
//! particle.

use crate::frames::{Frame, Mistake, OneCornerShort};
use crate::soil::{artificial_stress, on_cone};
use crate::water::{periodic, water};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Cone, Darcy, DruckerPrager, Material, Soil, SoilMemory, Water};
use alluvium::mixture::{ArtificialViscosity, Mixture, Phase};
use alluvium::neighbours::BruteForce;
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, StepSize};
use alluvium::verify::{Arrangement, Random, ShortSighted};
use alluvium::{Real, SymTensor, Vector};
use core::f64::consts::TAU;

pub type Both<T, const D: usize, S = Soil<T>> = Mixture<T, D, WendlandC2<T, D>, S, Water<T>>;
pub type Following<T, const D: usize, I> = Simulation<T, D, WendlandC2<T, D>, Soil<T>, Water<T>, I>;

/// What the cloud is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    Water,
    Soil,
    /// Both in the same space, with Darcy drag.
    Mixture,
}

impl Made {
    pub const ALL: [Self; 3] = [Self::Water, Self::Soil, Self::Mixture];
    pub const fn name(self) -> &'static str {
        match self {
            Self::Water => "water",
            Self::Soil => "soil",
            Self::Mixture => "mixture",
        }
    }
    pub fn has_soil(self) -> bool {
        self != Self::Water
    }
    pub fn has_water(self) -> bool {
        self != Self::Soil
    }
}

/// A study of every cloud, in both dimensions and precisions.
macro_rules! of_every_cloud {
    ($study:ident) => {
        crate::clouds::Made::ALL
            .into_iter()
            .flat_map(|made| {
                [
                    $study::<f64, 2>(made),
                    $study::<f64, 3>(made),
                    $study::<f32, 2>(made),
                    $study::<f32, 3>(made),
                ]
            })
            .collect()
    };
}
pub(crate) use of_every_cloud;

/// How many steps clouds are followed.
pub const STEPS: usize = 60;
/// Smoothing length over spacing.
const RATIO: f64 = 1.3;
/// Speed of sound in water, of which waves in the soil have about the same \[m/s\].
const SOUND: f64 = 20.0;
/// Speed of the flow \[m/s\].
pub const FLOW: f64 = 0.5;

/// A cloud, and how it is run.
#[derive(Clone, Copy, Debug)]
pub struct Cloud<const D: usize> {
    pub made: Made,
    /// In a box that repeats itself; else a round one in empty space, with weight.
    pub periodic: bool,
    /// Whether the gradients are corrected.
    pub corrected: bool,
    /// In which order particles are added; their own at 0.
    pub order: u64,
    /// Particles along an edge of the unit box.
    pub side: usize,
}

impl<const D: usize> Cloud<D> {
    pub fn new(made: Made) -> Self {
        Self { made, periodic: false, corrected: false, order: 0, side: if D == 2 { 16 } else { 10 } }
    }
    pub fn spacing(&self) -> f64 {
        1.0 / self.side as f64
    }
    /// The step \[s\]: a tenth of what sound needs for h.
    pub fn step(&self) -> f64 {
        0.1 * RATIO * self.spacing() / SOUND
    }

    /// Places of soil (0) or water (1) around the origin \[m\], in their own order.
    fn places(&self, seed: u64) -> Vec<[f64; D]> {
        let arranged = Arrangement::<D>::jittered(self.side, 0.2, 3 + seed).positions;
        let centred = arranged.into_iter().map(|x| x.map(|x| x - 0.5));
        let inside = |x: &[f64; D]| self.periodic || x.iter().map(|x| x * x).sum::<f64>() < 0.21;
        centred.filter(inside).collect()
    }

    /// Which particle is added k-th.
    fn order(&self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        let mut random = Random::new(self.order);
        if self.order > 0 {
            for k in (1..count).rev() {
                order.swap(k, (random.next_bits() % (k as u64 + 1)) as usize);
            }
        }
        order
    }

    /// The soil of these studies: it yields while they run.
    pub fn soil<T: Real>() -> Soil<T> {
        let [friction, dilatancy, cohesion] = [0.4, 0.1, 500.0].map(T::of);
        on_cone(DruckerPrager::cohesive(Cone::PlaneStrain, friction, dilatancy, cohesion).expect("a cone"))
    }

    /// At the start, in a frame.
    pub fn mixture<T: Real, S: Material<T, Memory = SoilMemory<T>>>(
        &self,
        law: S,
        frame: &Frame<D>,
        mistake: Option<Mistake>,
    ) -> Both<T, D, S> {
        let volume = T::of(self.spacing().powi(D as i32));
        let add = |seed: u64| -> Vec<Vector<T, D>> {
            let places = self.places(seed);
            self.order(places.len()).into_iter().map(|k| Vector::of(frame.vector(places[k]))).collect()
        };
        let moving = |x: &Vector<T, D>, phase: f64| {
            let v = frame.vector(velocity(frame.back(x.as_f64()), phase));
            Vector::of(core::array::from_fn(|k| v[k] + frame.velocity[k]))
        };
        let mut soil = Phase::new(law);
        if self.made.has_soil() {
            soil.add(&add(0), volume, |_| T::ZERO).expect("soil");
            soil.set_volume_fraction(|x| T::of(0.5 + 0.1 * wave(frame.back(x.as_f64()), 0.3)));
            soil.set_velocity(|x| moving(x, 0.0));
            soil.set_stress(|x| {
                let own = stress(frame.back(x.as_f64()));
                let seen = if mistake == Some(Mistake::StressStays) { own } else { frame.tensor(own) };
                SymTensor(seen.0.map(T::of))
            });
        }
        let mut fluid = Phase::new(water::<T>(SOUND, 0.01));
        if self.made.has_water() {
            let pressure = |x: &Vector<T, D>| T::of(2e3 * (1.0 + 0.5 * wave(frame.back(x.as_f64()), 0.0)));
            fluid.add(&add(1), volume, pressure).expect("water");
            fluid.set_velocity(|x| moving(x, 1.0));
        }
        if mistake == Some(Mistake::MixedUp) {
            let all = if self.made.has_soil() { soil.velocities_mut() } else { fluid.velocities_mut() };
            all.swap(0, 1);
        }
        self.with_numerics(soil, fluid, frame, mistake)
    }

    fn with_numerics<T: Real, S: Material<T, Memory = SoilMemory<T>>>(
        &self,
        soil: Phase<T, D, S>,
        fluid: Phase<T, D, Water<T>>,
        frame: &Frame<D>,
        mistake: Option<Mistake>,
    ) -> Both<T, D, S> {
        let speed = frame.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        let signal = if mistake == Some(Mistake::AbsoluteSpeed) { 1.0 + speed / SOUND } else { 1.0 };
        let viscosity = ArtificialViscosity { linear: T::of(0.1 * signal), quadratic: T::ONE };
        let kernel = WendlandC2::new(T::of(RATIO * self.spacing())).expect("a length");
        let mixture = Mixture::new(kernel, soil, fluid)
            .with_artificial_viscosity(viscosity)
            .and_then(|mixture| mixture.with_soil_artificial_viscosity(viscosity))
            .and_then(|mixture| mixture.with_density_relaxation(T::of(0.05)))
            .and_then(|mixture| mixture.with_artificial_stress(artificial_stress(self.spacing())))
            .expect("numerics")
            .with_drag(Darcy::new(Conductivity::new(T::of(0.05)).expect("a conductivity")));
        let mixture = if self.corrected { mixture.with_gradient_correction() } else { mixture };
        let mixture = match mistake {
            Some(Mistake::Corner) => mixture.with_search(|| Box::<OneCornerShort<T, D>>::default()),
            // The list reaches a tenth further than the support: less would not be a mistake.
            Some(Mistake::ShortSighted) => {
                mixture.with_search(|| Box::new(ShortSighted::new(Box::<BruteForce>::default(), 0.99 / 1.1)))
            }
            _ => mixture,
        };
        if self.periodic {
            return mixture.with_periodic(periodic([1.0; D]));
        }
        let own = core::array::from_fn(|k| if k == 0 { 4.0 } else { -9.0 });
        let seen = if mistake == Some(Mistake::GravityStays) { own } else { frame.vector(own) };
        mixture.with_gravity(Vector::of(seen))
    }

    /// After [`STEPS`] equal steps.
    pub fn seen<T: Real>(
        &self,
        integrator: impl Integrator<T>,
        frame: &Frame<D>,
        mistake: Option<Mistake>,
    ) -> Seen<D> {
        let step = StepSize::fixed(T::of(self.step())).expect("a step");
        let mut run = Simulation::new(self.mixture(Self::soil(), frame, mistake), integrator, step);
        for _ in 0..STEPS {
            run.step().expect("a step");
        }
        self.read(run.mixture())
    }

    /// Every particle, whatever the order in which they were added.
    pub fn read<T: Real>(&self, mixture: &Both<T, D>) -> Seen<D> {
        let (soil, water) = (mixture.soil(), mixture.water());
        Seen {
            longest_step: mixture.limits().binding(T::of(0.2)).0.as_f64(),
            soil: self.in_own_order(soil.ids(), |i| Particle {
                position: soil.positions()[i].as_f64(),
                velocity: soil.velocities()[i].as_f64(),
                compression: 0.0,
                fraction: soil.volume_fraction(i).as_f64(),
                stress: SymTensor(soil.memory(i).stress.0.map(T::as_f64)),
            }),
            water: self.in_own_order(water.ids(), |i| Particle {
                position: water.positions()[i].as_f64(),
                velocity: water.velocities()[i].as_f64(),
                compression: water.compression(i).as_f64(),
                fraction: water.volume_fraction(i).as_f64(),
                stress: SymTensor::zero(),
            }),
        }
    }

    fn in_own_order(&self, ids: &[u32], particle: impl Fn(usize) -> Particle<D>) -> Vec<Particle<D>> {
        let order = self.order(ids.len());
        let mut all: Vec<_> = (0..ids.len()).map(|i| (order[ids[i] as usize], particle(i))).collect();
        all.sort_unstable_by_key(|(own, _)| *own);
        all.into_iter().map(|(_, particle)| particle).collect()
    }
}

/// A number in −1…1 at a place, the same a box further.
fn wave<const D: usize>(x: [f64; D], phase: f64) -> f64 {
    (TAU * x[0] + phase).sin()
        * (TAU * x[1] - phase).cos()
        * if D == 3 { (TAU * x[D - 1]).cos() } else { 1.0 }
}

/// A flow of [`FLOW`] \[m/s\] that compresses and shears.
fn velocity<const D: usize>(x: [f64; D], phase: f64) -> [f64; D] {
    core::array::from_fn(|k| {
        let (own, next) = (TAU * x[k], TAU * x[(k + 1) % D]);
        FLOW * (0.7 * (next + phase + k as f64).sin() + 0.3 * (own + phase).cos())
    })
}

/// Stress \[Pa\], with every component the dimension has.
fn stress<const D: usize>(x: [f64; D]) -> SymTensor<f64> {
    let at = |phase: f64| 400.0 * wave(x, phase);
    let out = if D == 3 { 1.0 } else { 0.0 };
    SymTensor([at(0.2) - 600.0, at(1.1) - 400.0, at(0.7) - 500.0, at(2.0), out * at(0.4), out * at(1.6)])
}

/// One particle, as plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle<const D: usize> {
    pub position: [f64; D],
    pub velocity: [f64; D],
    pub compression: f64,
    pub fraction: f64,
    pub stress: SymTensor<f64>,
}

/// All of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen<const D: usize> {
    /// That the limits of the step allow \[s\].
    pub longest_step: f64,
    pub soil: Vec<Particle<D>>,
    pub water: Vec<Particle<D>>,
}
