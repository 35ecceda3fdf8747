//! The library's own searches, laws and integrators under the studies that are ready made for anybody's.

use alluvium::Real;
use alluvium::material::{
    Conductivity, Cone, Darcy, DruckerPrager, Ergun, MohrCoulomb, NoDrag, Plasticity, Soil, Unyielding, Water,
};
use alluvium::neighbours::CellList;
use alluvium::time::{LeapFrog, VelocityVerlet};
use alluvium::verify::{Study, ready};

use crate::driver::{cone, elasticity, soil};

pub fn studies() -> Vec<Study> {
    let mut studies = searches::<f64, 2>();
    studies.extend(searches::<f64, 3>());
    studies.extend(searches::<f32, 2>());
    studies.extend(searches::<f32, 3>());
    studies.extend(of::<f64>());
    studies.extend(of::<f32>());
    studies
}

fn searches<T: Real, const D: usize>() -> Vec<Study> {
    let name = |what: &str| format!("ready/{what}/{D}d/{}", T::NAME);
    let mut studies = ready::search::<T, D>(&name("cell list"), || Box::new(CellList::default()));
    #[cfg(feature = "kd-tree")]
    studies.extend(ready::search::<T, D>(&name("kd-tree"), || {
        Box::new(alluvium::neighbours::KdTree::default())
    }));
    studies
}

fn of<T: Real>() -> Vec<Study> {
    let name = |what: &str| format!("ready/{what}/{}", T::NAME);
    let water = Water::new(T::of(1000.0), T::of(25.0)).and_then(|water| water.with_viscosity(T::ONE));
    let mut studies = ready::law(&name("water"), water.expect("a fluid"));
    studies.extend(ready::law(&name("elastic"), soil::<T, _>(Unyielding)));
    for plasticity in [Plasticity::ReturnMapping, Plasticity::Rate] {
        let name = |what: &str| name(&format!("{what}, {plasticity:?}"));
        let sand: Soil<T> = soil(cone(Cone::PlaneStrain, 25.0, 5.0));
        studies.extend(ready::law(&name("sand"), sand.with_plasticity(plasticity)));
        let [friction, cohesion] = [T::of(0.35), T::of(300.0)];
        let loam = DruckerPrager::cohesive(Cone::TriaxialCompression, friction, T::ZERO, cohesion);
        let loam = Soil::new(T::of(2650.0), elasticity(), loam.expect("a cone")).expect("a density");
        studies.extend(ready::law(&name("loam"), loam.with_plasticity(plasticity)));
        let faces = MohrCoulomb::new(T::of(0.44), T::of(0.1)).expect("angles");
        studies.extend(ready::law(&name("pyramid"), soil::<T, _>(faces).with_plasticity(plasticity)));
    }
    let darcy = Darcy::new(Conductivity::new(T::of(1e-3)).expect("a conductivity"));
    let ergun = Ergun::new(T::of(1e-3), T::of(1e-3)).expect("grains");
    studies.extend(ready::drag::<T, _>(&name("Darcy"), darcy));
    studies.extend(ready::drag::<T, _>(&name("Ergun"), ergun));
    studies.extend(ready::drag::<T, _>(&name("no drag"), NoDrag));
    studies.extend(ready::integrator::<T, _>(&name("leap-frog"), LeapFrog::new));
    let third_order_density = || LeapFrog::new().with_third_order_density();
    studies
        .extend(ready::integrator::<T, _>(&name("leap-frog, density of third order"), third_order_density));
    studies.extend(ready::integrator::<T, _>(&name("velocity-Verlet"), VelocityVerlet::new));
    studies
}
