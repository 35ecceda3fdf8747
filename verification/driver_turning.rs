//! Soil laws that turn, and how they converge to their rate equations.

use crate::bench::measured;
use crate::driver::{cone, elasticity, soil};
use crate::driver_laws::{Mistake, Mistaken, Slip, Slipped};
use alluvium::driver::{Driver, Kind, Leg, Path};
use alluvium::material::{Cone, Plasticity, SoilMemory, Unyielding};
use alluvium::verify::{Conditions, Expected, Measured, Study, ready};
use alluvium::{Real, SymTensor};

const SPIN: &str = "spin of the wrong sign";
const SHEAR: &str = "½ left out of the shear rate";
const SCALED: &str = "scaled back where it should return";
const MEAN: &str = "p for I₁";

pub fn studies() -> Vec<Study> {
    let mut studies = turning::<f64>(1e-12, 2000);
    studies.extend(turning::<f32>(1e-5, 40));
    studies.extend(orders());
    studies
}

fn turning<T: Real>(largest: f64, increments: usize) -> Vec<Study> {
    let name = |what: &str| format!("driver/{what}/{}", T::NAME);
    vec![
        Study::new(
            name("rotation"),
            "stress turns with a rigid rotation, whatever its angle, and so does its answer to strain",
            |conditions| measured(&ready::law("elastic", elastic::<T>(conditions)), "objectivity", &AS_IT_IS),
        )
        .equations(&["33", "34", "35"])
        .source("exact: R σ Rᵀ")
        .expect(Expected::Bound { largest })
        .mutant(SPIN),
        Study::new(
            name("simple shear"),
            "elastic simple shear: τ_xy = G sin γ, τ_xx = −τ_yy = G (1 − cos γ)",
            move |conditions| Measured::values(sheared::<T>(increments, conditions)),
        )
        .equations(&["22", "34", "35"])
        .source("exact solution of (34)")
        .expect(Expected::Bound { largest })
        .mutant(SPIN)
        .mutant(SHEAR),
    ]
}

/// The mistake is in the law already.
const AS_IT_IS: Conditions = Conditions { mutant: None };

fn elastic<T: Real>(conditions: &Conditions) -> Mistaken<T> {
    let mistakes = [(SPIN, Mistake::Spin), (SHEAR, Mistake::Shear)];
    let found = mistakes.iter().find(|(name, _)| conditions.is(name));
    Mistaken { soil: soil(Unyielding), mistake: found.map_or(Mistake::None, |found| found.1) }
}

fn sheared<T: Real>(increments: usize, conditions: &Conditions) -> Vec<(String, f64)> {
    let g = elasticity::<T>().shear().as_f64();
    let mut values = Vec::new();
    for shear in [0.3, 1.0, 2.0_f64] {
        let mut driver = Driver::new(elastic::<T>(conditions), SoilMemory::default());
        let rows = driver.run(&Path::new(Kind::SimpleShear, T::of(shear)), increments).expect("a path");
        let [xx, yy, zz, xy, ..] = rows[increments].stress.0.map(|x| x.as_f64() / g);
        values.push((format!("xx at γ = {shear}"), xx - (1.0 - shear.cos())));
        values.push((format!("yy at γ = {shear}"), yy + (1.0 - shear.cos())));
        values.push((format!("zz at γ = {shear}"), zz));
        values.push((format!("xy at γ = {shear}"), xy - shear.sin()));
    }
    values
}

/// Convergence along a path on which the direction of flow turns all the way.
fn orders() -> Vec<Study> {
    let study = |name: &str, claim: &str, run: fn(usize, &Conditions) -> f64| {
        Study::new(format!("driver/order/{name}"), claim, move |conditions| {
            Measured::errors([20, 40, 80, 160].map(|n| (1.0 / n as f64, run(n, conditions))))
        })
    };
    vec![
        study("closed form", "return mapping converges to the exact solution with order 1", from_exact)
            .source("Krieg & Krieg (1977): tan(β/2) decays as exp(−2G|ė|t/|τ|) on a fixed circle")
            .expect(Expected::order(1.0, 0.05))
            .mutant(MEAN),
        study("rate equations", "return mapping converges to the rate equations with order 1", from_rates)
            .equations(&["21", "24", "25", "26"])
            .source("(30)–(36) by 20 000 steps of a method of order 4")
            .expect(Expected::order(1.0, 0.05))
            .mutant(SCALED),
    ]
}

/// On the cone at 1 kPa, sheared along xy.
fn on_the_cone(friction: f64) -> SymTensor<f64> {
    let mut stress = SymTensor::isotropic(-1e3);
    stress.0[3] = 3e3 * friction;
    stress
}

/// Keeps the volume and turns the shear, from xy to xx − yy.
const STRAIN: [f64; 6] = [0.002, -0.002, 0.0, 0.0005, 0.0, 0.0];

fn driven(surface: Slipped<f64>, plasticity: Plasticity, increments: usize) -> SymTensor<f64> {
    let start = SoilMemory::stressed(on_the_cone(surface.cone.friction()));
    let mut driver = Driver::new(soil(surface).with_plasticity(plasticity), start);
    driver.follow(&Leg::strain(SymTensor(STRAIN)), increments).expect("a path");
    driver.row().stress
}

fn apart(a: &SymTensor<f64>, b: &SymTensor<f64>) -> f64 {
    ((*a - *b).double_dot(&(*a - *b)) / b.double_dot(b)).sqrt()
}

fn mapped(dilatancy: f64, increments: usize, conditions: &Conditions) -> SymTensor<f64> {
    let slips = [(SCALED, Slip::ScaledBack), (MEAN, Slip::MeanForI1)];
    let slip = slips.iter().find(|(name, _)| conditions.is(name)).map_or(Slip::None, |slip| slip.1);
    let cone = cone(Cone::PlaneStrain, 25.0, dilatancy);
    driven(Slipped { cone, slip }, Plasticity::ReturnMapping, increments)
}

fn from_exact(increments: usize, conditions: &Conditions) -> f64 {
    let surface = cone::<f64>(Cone::PlaneStrain, 25.0, 0.0);
    let (start, strain) = (on_the_cone(surface.friction()).deviator(), SymTensor(STRAIN));
    let norm = |t: &SymTensor<f64>| t.double_dot(t).sqrt();
    let (radius, size) = (norm(&start), norm(&strain));
    let along = strain * (1.0 / size);
    let across = start - along * start.double_dot(&along);
    let across = across * (1.0 / norm(&across));
    let beta = (start.double_dot(&along) / radius).acos();
    let decayed = (0.5 * beta).tan() * (-2.0 * elasticity::<f64>().shear() * size / radius).exp();
    let beta = 2.0 * decayed.atan();
    let exact = (along * beta.cos() + across * beta.sin()) * radius + SymTensor::isotropic(-1e3);
    apart(&mapped(0.0, increments, conditions), &exact)
}

fn from_rates(increments: usize, conditions: &Conditions) -> f64 {
    let surface = Slipped { cone: cone(Cone::PlaneStrain, 25.0, 10.0), slip: Slip::None };
    let reference = driven(surface, Plasticity::Rate, 20_000);
    apart(&mapped(10.0, increments, conditions), &reference)
}
