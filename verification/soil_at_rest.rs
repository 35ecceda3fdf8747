//! Soil that was laid down and left alone starts inside its yield surface (75), (76).

use crate::soil::{elasticity, on_cone};
use alluvium::Real;
use alluvium::material::{Cone, DruckerPrager, LateralRatio, Material, SoilMemory};
use alluvium::verify::{Conditions, Expected, Measured, Study};

const OUTSIDE: &str = "K₀ = ν/(1 − ν), outside the yield surface";

pub fn studies() -> Vec<Study> {
    vec![study::<f64>("soil/at rest/f64", 1e-12), study::<f32>("soil/at rest/f32", 1e-5)]
}

fn study<T: Real>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "the stress at rest is admissible: the first return to the yield surface takes nothing of it (values: \
         change of the vertical stress, relative)",
        |conditions| {
            let cones = [(19.8, Cone::PlaneStrain), (25.0, Cone::PlaneStrain), (25.0, Cone::PlaneStrainNonDilatant)];
            Measured::values(cones.map(|(angle, cone)| {
                (format!("{cone:?} at {angle}°"), change::<T>(angle, cone, conditions))
            }))
        },
    )
    .equations(&["27", "29", "75", "76"])
    .source("K₀ ≥ (1 − √3 α_θ)/(1 + 2√3 α_θ), from F = 0 under a vertical and two lateral stresses")
    .expect(Expected::Bound { largest })
    .mutant(OUTSIDE)
}

/// How much of a vertical stress of 1 kPa the return takes.
fn change<T: Real>(angle: f64, cone: Cone, conditions: &Conditions) -> f64 {
    let cone = DruckerPrager::new(cone, T::of(angle.to_radians()), T::ZERO).expect("a cone");
    let ratio = LateralRatio::new(&elasticity(), &cone);
    let ratio = if conditions.is(OUTSIDE) { ratio.printed } else { ratio.admissible() };
    let start = SoilMemory::geostatic(T::of(-1e3), ratio, 1);
    let (end, _) = on_cone(cone).admit(start);
    (end.stress.0[1] / start.stress.0[1] - T::ONE).as_f64()
}
