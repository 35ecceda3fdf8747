//! Small runs that several tests share.

use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Absent, Material, Water};
use alluvium::mixture::{Mixture, Phase, Wall};
use alluvium::{Real, Vector, setup};

/// A collapsing column of water in the corner of a tank, filling `width` × `height` (× `depth`) of it
/// \[m\]; gravity along the second axis.
#[derive(Clone, Copy)]
pub struct Dam {
    pub water: [f64; 3],
    pub tank: [f64; 3],
    pub spacing: f64,
}

impl Dam {
    /// 1 250 water particles in 2D.
    pub const SMALL: Self = Self { water: [0.1, 0.2, 0.1], tank: [0.4, 0.3, 0.1], spacing: 0.004 };

    /// The dam of `law` with kernel `kernel`, in a tank of kind `wall`, under the pressure of still
    /// water.
    pub fn of<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>>(
        &self,
        kernel: K,
        law: F,
        wall: Wall<T, D>,
    ) -> Mixture<T, D, K, Absent, F> {
        let volume = T::of(self.spacing.powi(D as i32));
        let (water, tank) = (first::<D>(self.water), first::<D>(self.tank));
        let g = T::of(9.81);
        let still = setup::hydrostatic::<T, D>(law.reference_density(), g, 1, T::of(self.water[1]));
        let mut phase = Phase::new(law);
        let walls = setup::tank([0.0; D], tank, self.spacing, 3, [(true, true); D]);
        phase.add_wall(wall, &walls, volume, &still).unwrap();
        phase.add(&setup::fill([0.0; D], water, self.spacing), volume, &still).unwrap();
        let mut down = Vector::zero();
        down[1] = -g;
        Mixture::of_water(kernel, phase).with_gravity(down)
    }

    /// The dam of water with c = 25 m/s and the Wendland C2 kernel, h = 1.3 Δx.
    pub fn mixture<T: Real, const D: usize>(&self, wall: Wall<T, D>) -> Mixture<T, D> {
        let kernel = WendlandC2::new(T::of(1.3 * self.spacing)).unwrap();
        self.of(kernel, Water::new(T::of(1000.0), T::of(25.0)).unwrap(), wall)
    }
}

fn first<const D: usize>(x: [f64; 3]) -> [f64; D] {
    core::array::from_fn(|k| x[k])
}
