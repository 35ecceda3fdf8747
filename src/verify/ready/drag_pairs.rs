//! What a law of drag does to pairs of particles, one of soil and one of water.

use super::drag::NEGATIVE;
use super::worst;
use crate::budget::Account;
use crate::kernel::WendlandC2;
use crate::material::{DragLaw, Elasticity, Soil, Unyielding, Water};
use crate::mixture::{Mixture, Phase};
use crate::real::Real;
use crate::space::Vector;
use crate::time::Evolve;
use crate::verify::{Conditions, Measured, Random};

pub(super) const NO_REACTION: &str = "soil does not feel the drag";
pub(super) const UNBOOKED: &str = "drag not booked";

/// Pairs for each slip.
const PAIRS: usize = 8;
const SLIPS: [f64; 4] = [1e-3, 0.1, 1.0, 10.0];
/// Space a particle stands for, per axis \[m\].
const SPACING: f64 = 0.01;

/// A law whose coefficient has the other sign.
#[derive(Debug)]
struct Negative<L>(L);

impl<T: Real, L: DragLaw<T>> DragLaw<T> for Negative<L> {
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T {
        -self.0.coefficient(fraction, true_density, slip)
    }
    fn knows_slip(&self) -> bool {
        self.0.knows_slip()
    }
}

/// What drag does to a pair.
struct Dragged<const D: usize> {
    /// Forces on soil and on water \[N, in 2D N/m\].
    force: [[f64; D]; 2],
    velocity: [[f64; D]; 2],
    /// What the ledger says it takes \[W, in 2D W/m\].
    booked: f64,
}

impl<const D: usize> Dragged<D> {
    /// What drag gives each \[W, in 2D W/m\].
    fn powers(&self) -> [f64; 2] {
        [0, 1].map(|n| (0..D).map(|k| self.force[n][k] * self.velocity[n][k]).sum())
    }
}

/// Soil and water at a distance within the support, in random directions and at about this slip \[m/s\].
fn pair<T: Real, const D: usize, L: DragLaw<T> + Clone + 'static>(
    law: &L,
    conditions: &Conditions,
    slip: f64,
    random: &mut Random,
) -> Dragged<D> {
    let mut within = |size: f64| -> Vector<T, D> {
        Vector::of(core::array::from_fn(|_| size * random.between(-1.0, 1.0)))
    };
    let volume = T::of(SPACING.powi(D as i32));
    let elasticity = Elasticity::from_bulk(T::of(1e6), T::of(0.3)).expect("moduli");
    let mut soil = Phase::new(Soil::new(T::of(2650.0), elasticity, Unyielding).expect("a soil"));
    soil.add(&[within(0.3 * SPACING)], volume, |_| T::ZERO).expect("a particle");
    soil.set_volume_fraction(|_| T::of(0.5));
    let of_soil = within(slip);
    soil.set_velocity(|_| of_soil);
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(100.0)).expect("a water"));
    water.add(&[within(0.3 * SPACING)], volume, |_| T::ZERO).expect("a particle");
    let of_water = within(slip);
    water.set_velocity(|_| of_water);
    let kernel = WendlandC2::new(T::of(1.3 * SPACING)).expect("a length");
    // Nothing else acts: neither has a neighbour of its own, nor stress, nor pressure.
    let mixture = Mixture::new(kernel, soil, water);
    let mut mixture = match conditions.is(NEGATIVE) {
        true => mixture.with_drag(Negative(law.clone())),
        false => mixture.with_drag(law.clone()),
    };
    mixture.evaluate().expect("finite rates");
    let (soil, water) = (mixture.soil(), mixture.water());
    let force = |mass: T, a: Vector<T, D>| a.as_f64().map(|a| mass.as_f64() * a);
    let reaction = if conditions.is(NO_REACTION) { 0.0 } else { 1.0 };
    Dragged {
        force: [
            force(soil.masses()[0], soil.accelerations()[0]).map(|f| reaction * f),
            force(water.masses()[0], water.accelerations()[0]),
        ],
        velocity: [of_soil.as_f64(), of_water.as_f64()],
        booked: if conditions.is(UNBOOKED) { 0.0 } else { mixture.exchange_rate().taken[Account::Drag] },
    }
}

/// The worst of many pairs in two and in three dimensions, for each slip.
fn pairs<T: Real, L: DragLaw<T> + Clone + 'static>(
    law: &L,
    conditions: &Conditions,
    plane: fn(&Dragged<2>) -> f64,
    space: fn(&Dragged<3>) -> f64,
) -> Measured {
    let mut random = Random::new(23);
    Measured::values(SLIPS.map(|slip| {
        let all = (0..PAIRS).flat_map(|_| {
            let in_plane = plane(&pair::<T, 2, L>(law, conditions, slip, &mut random));
            [in_plane, space(&pair::<T, 3, L>(law, conditions, slip, &mut random))]
        });
        (format!("slips of {slip} m/s"), worst(all))
    }))
}

pub(super) fn momentum<T: Real, L: DragLaw<T> + Clone + 'static>(
    law: &L,
    conditions: &Conditions,
) -> Measured {
    pairs::<T, L>(law, conditions, left_over::<2>, left_over::<3>)
}

pub(super) fn energy<T: Real, L: DragLaw<T> + Clone + 'static>(law: &L, conditions: &Conditions) -> Measured {
    pairs::<T, L>(law, conditions, created::<2>, created::<3>)
}

/// Of both forces together, over their sizes.
fn left_over<const D: usize>(pair: &Dragged<D>) -> f64 {
    let [soil, water] = pair.force;
    let size: f64 = soil.iter().chain(&water).map(|f| f.abs()).sum();
    let sum: f64 = (0..D).map(|k| (soil[k] + water[k]).abs()).sum();
    if size == 0.0 { 0.0 } else { sum / size }
}

/// Energy that is created, or that the ledger does not know, over the powers of both forces.
fn created<const D: usize>(pair: &Dragged<D>) -> f64 {
    let [soil, water] = pair.powers();
    let given = soil + water;
    let size = soil.abs() + water.abs();
    if size == 0.0 { pair.booked.abs() } else { given.max((given + pair.booked).abs()) / size }
}
