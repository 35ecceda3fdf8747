//! Set-ups that several topics share.

use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase, Wall};
use alluvium::neighbours::Periodic;
use alluvium::verify::dam_break;
use alluvium::{Preset, Real, Vector, setup};

/// Water on a lattice in a tank with the origin in its lower left corner, open above.
#[derive(Clone, Copy, Debug)]
pub struct Tank<const D: usize> {
    /// Extent of the water \[m\].
    pub water: [f64; D],
    /// Extent of the tank inside \[m\].
    pub tank: [f64; D],
    /// Particle spacing \[m\].
    pub spacing: f64,
    /// Speed of sound \[m/s\].
    pub sound_speed: f64,
    /// Viscosity \[Pa·s\].
    pub viscosity: f64,
    pub preset: Preset,
    /// The axis along which space repeats itself, if any; there are no walls across it.
    pub periodic: Option<usize>,
}

impl Tank<2> {
    /// The paper's dam break (Table 1). The walls are five times as high as the column, to keep all that shoots
    /// up the far side.
    pub fn dam_break(spacing: f64, preset: Preset) -> Self {
        Self {
            water: [dam_break::WIDTH, dam_break::HEIGHT],
            tank: [dam_break::TANK, 5.0 * dam_break::HEIGHT],
            spacing,
            sound_speed: 25.0,
            viscosity: 1e-3,
            preset,
            periodic: None,
        }
    }
}

impl Tank<3> {
    /// A slab of the paper's dam break, `depth` \[m\] deep, endless across. Its walls are high enough until the
    /// water is at the far one.
    pub fn dam_break_slab(spacing: f64, depth: f64, preset: Preset) -> Self {
        let flat = Tank::dam_break(spacing, preset);
        Self {
            water: [flat.water[0], flat.water[1], depth],
            tank: [flat.tank[0], 2.0 * flat.water[1], depth],
            spacing,
            sound_speed: flat.sound_speed,
            viscosity: flat.viscosity,
            preset,
            periodic: Some(2),
        }
    }
}

impl<const D: usize> Tank<D> {
    /// The particles under hydrostatic pressure, the axis y pointing up.
    pub fn mixture<T: Real>(&self, wall: Wall<T, D>) -> Mixture<T, D> {
        self.mixture_without(wall, &|_| false)
    }

    /// The same without the wall particles that `missing` names by number.
    pub fn mixture_without<T: Real>(
        &self,
        wall: Wall<T, D>,
        missing: &dyn Fn(usize) -> bool,
    ) -> Mixture<T, D> {
        let kernel: WendlandC2<T, D> =
            WendlandC2::new(T::of(self.preset.smoothing_ratio() * self.spacing)).expect("a positive length");
        let water = Water::new(T::of(1000.0), T::of(self.sound_speed))
            .and_then(|water| water.with_viscosity(T::of(self.viscosity)))
            .expect("sound parameters");
        let volume = T::of(self.spacing.powi(D as i32));
        let pressure = setup::hydrostatic(T::of(1000.0), T::of(dam_break::GRAVITY), 1, T::of(self.water[1]));
        let layers = self.preset.wall_layers(kernel.support().as_f64() / self.spacing);
        let closed = core::array::from_fn(|axis| match axis {
            1 => (true, false),
            _ => (self.periodic != Some(axis), self.periodic != Some(axis)),
        });
        let mut phase = Phase::new(water);
        // A wall under the water carries its pressure from the start.
        let mut walls = setup::tank([0.0; D], self.tank, self.spacing, layers, closed);
        let mut number = 0..walls.len();
        walls.retain(|_| !number.next().is_some_and(missing));
        phase.add_wall(wall, &walls, volume, |x| self.under_water(x, &pressure)).expect("finite");
        phase.add(&setup::fill([0.0; D], self.water, self.spacing), volume, &pressure).expect("finite");
        let mut gravity = [0.0; D];
        gravity[1] = -dam_break::GRAVITY;
        let mut length = [None; D];
        if let Some(axis) = self.periodic {
            length[axis] = Some(T::of(self.tank[axis]));
        }
        let periodic = Periodic::new(Vector::zero(), length).expect("a positive length");
        let mixture =
            Mixture::of_water(kernel, phase).with_gravity(Vector::of(gravity)).with_periodic(periodic);
        self.preset.apply(mixture)
    }

    fn under_water<T: Real>(&self, x: &Vector<T, D>, pressure: &impl Fn(&Vector<T, D>) -> T) -> T {
        let beside = (0..D).filter(|&k| k != 1).all(|k| x[k].as_f64() < self.water[k] + 4.0 * self.spacing);
        if beside { pressure(x) } else { T::ZERO }
    }
}
