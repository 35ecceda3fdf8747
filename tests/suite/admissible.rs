//! After any update the stress is on its yield surface or inside: Drucker and Prager's cone, Mohr and Coulomb's pyramid.

use alluvium::driver::{Driver, Leg};
use alluvium::material::{
    Cone, DruckerPrager, Elasticity, Flow, Material, Memory, MohrCoulomb, Plasticity, Returned, Soil,
    SoilMemory, YieldSurface,
};
use alluvium::{Real, SymTensor};
use proptest::prelude::*;

/// After one increment from a stress, F is at most `bar` of the pressure; with cohesion, of it if it is larger: F adds
/// both up, and on the surface neither shear nor pressure is out of proportion to them, but the pressure may be zero.
fn update_is_admitted<T: Real, Y: YieldSurface<T>>(
    surface: Y,
    cohesion: f64,
    [stress, strain]: [[f64; 6]; 2],
    bar: f64,
) -> Result<(), TestCaseError> {
    let elasticity = Elasticity::new(T::of(0.84e6), T::of(0.3)).unwrap();
    for plasticity in [Plasticity::ReturnMapping, Plasticity::Rate] {
        let law = Soil::new(T::of(2650.0), elasticity, surface.clone()).unwrap().with_plasticity(plasticity);
        let start = law.admit(SoilMemory::stressed(SymTensor(stress.map(T::of)))).0;
        let leg = Leg::strain(SymTensor(strain.map(T::of))).turning([0.1, -0.2, 0.3].map(T::of));
        let row = Driver::new(law.clone(), start).follow(&leg, 1).unwrap()[0];
        let [excess, p, limit] =
            [surface.excess(&row.stress), row.pressure(), surface.largest_tension()].map(T::as_f64);
        let scale = p.abs().max(cohesion);
        let what = format!("{surface:?}, {plasticity:?}");
        prop_assert!(excess <= bar * scale, "{what}: F = {excess:e} at p = {p:e}");
        prop_assert!(-p <= limit + bar * scale, "{what}: tension {:e}", -p);
        let again = law.admit(row.memory).1.total().as_f64().abs();
        prop_assert!(again <= bar * (1.0 + scale), "{what}: once is enough, {again:e}");
    }
    Ok(())
}

/// A pyramid whose way back ends a billionth of the stress outside.
#[derive(Clone, Debug)]
struct Short(MohrCoulomb<f64>);

impl YieldSurface<f64> for Short {
    fn excess(&self, stress: &SymTensor<f64>) -> f64 {
        self.0.excess(stress)
    }
    fn flow(&self, stress: &SymTensor<f64>) -> Flow<f64> {
        self.0.flow(stress)
    }
    fn largest_tension(&self) -> f64 {
        self.0.largest_tension()
    }
    fn returned(&self, elasticity: &Elasticity<f64>, trial: &SymTensor<f64>) -> Returned<f64> {
        let back = self.0.returned(elasticity, trial);
        Returned { stress: back.stress + (*trial - back.stress) * 1e-9, ..back }
    }
}

#[test]
fn a_return_that_ends_short_of_the_surface_shows() {
    let pyramid = MohrCoulomb::new(0.5, 0.1).unwrap();
    let way = [[-1e3, -2e3, -1.5e3, 300.0, 0.0, 100.0], [-1e-3, -0.2, 0.1, 0.3, 0.0, 0.02]];
    assert!(update_is_admitted(pyramid, 0.0, way, 1e-12).is_ok());
    assert!(update_is_admitted(Short(pyramid), 0.0, way, 1e-12).is_err());
}

/// At an apex rounding decides on which side a stress without shear is; the way back must not divide by that shear.
#[test]
fn a_stress_at_the_apex_stays_a_number() {
    fn stays<Y: YieldSurface<f32>>(surface: Y) {
        for plasticity in [Plasticity::ReturnMapping, Plasticity::Rate] {
            let elasticity = Elasticity::new(0.84e6, 0.3).unwrap();
            let law = Soil::new(2650.0, elasticity, surface.clone()).unwrap().with_plasticity(plasticity);
            let apex = SymTensor::isotropic(surface.largest_tension());
            let (memory, loss) = law.admit(SoilMemory::stressed(apex));
            let moved = (memory.stress.0[0] - apex.0[0]).abs();
            assert!(moved <= 1e-5 * apex.0[0], "{surface:?}, {plasticity:?}: {memory:?}");
            assert!(memory.is_finite() && loss.total().is_finite(), "{surface:?}, {plasticity:?}");
        }
    }
    for k in 1..1000 {
        let cohesion = k as f32 * 0.7;
        stays(DruckerPrager::cohesive(Cone::PlaneStrain, 0.44, 0.0, cohesion).unwrap());
        stays(MohrCoulomb::cohesive(0.44, 0.1, cohesion).unwrap());
    }
}

proptest! {
    /// Both ways back, on every cone and on the pyramid, from anywhere, without cohesion and with it.
    #[test]
    fn no_update_leaves_a_stress_outside(
        stress in prop::array::uniform6(-1.0..1.0_f64), increment in prop::array::uniform6(-1.0..1.0_f64),
        size in 0.0..6.0_f64, reach in -6.0..0.0_f64,
        friction in 5.0..45.0_f64, share in 0.0..=1.0_f64, which in 0..5_usize, strength in 0.0..5.0_f64,
    ) {
        let [theta, psi] = [friction.to_radians(), (friction * share).to_radians()];
        let way = [(stress, size), (increment, reach)].map(|(six, power)| six.map(|x| x * 10_f64.powf(power)));
        for cohesion in [0.0, 10_f64.powf(strength)] {
            let cone = DruckerPrager::cohesive(Cone::ALL[which], theta, psi, cohesion).unwrap();
            let pyramid = MohrCoulomb::cohesive(theta, psi, cohesion).unwrap();
            update_is_admitted(cone, cohesion, way, 1e-12)?;
            update_is_admitted(pyramid, cohesion, way, 1e-12)?;
            let [theta, psi, c] = [theta, psi, cohesion].map(|x| x as f32);
            update_is_admitted(DruckerPrager::cohesive(Cone::ALL[which], theta, psi, c).unwrap(), cohesion, way, 1e-5)?;
            update_is_admitted(MohrCoulomb::cohesive(theta, psi, c).unwrap(), cohesion, way, 1e-5)?;
        }
    }
}
