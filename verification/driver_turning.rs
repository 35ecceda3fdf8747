//! Soil laws that turn, and how they converge to their rate equations.

use crate::driver::{cone, elasticity, soil};
use crate::driver_laws::{Mistake, Mistaken, Slip, Slipped};
use alluvium::driver::{Driver, Kind, Leg, Path};
use alluvium::material::{Cone, Plasticity, SoilMemory, Unyielding};
use alluvium::verify::{Conditions, Expected, Measured, Study};
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
    let rotation = |what: &str, axes: &'static [[f64; 3]]| {
        Study::new(
            name(what),
            "stress turns with a rigid rotation, whatever its angle",
            move |conditions: &Conditions| {
                let mut values = Vec::new();
                for axis in axes {
                    for degrees in [30.0, 45.0, 70.7, 90.0, 135.0] {
                        let error = rotated::<T>(axis, f64::to_radians(degrees), increments, conditions);
                        values.push((format!("{degrees}° about {axis:?}"), error));
                    }
                }
                Measured::values(values)
            },
        )
        .equations(&["33", "34", "35"])
        .source("exact: R σ Rᵀ")
        .expect(Expected::Bound { largest })
        .mutant(SPIN)
    };
    vec![
        rotation("rotation/2d", &[[0.0, 0.0, 1.0]]),
        rotation("rotation/3d", &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.36, -0.48, 0.8]]),
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

fn elastic<T: Real>(conditions: &Conditions) -> Mistaken<T> {
    let mistakes = [(SPIN, Mistake::Spin), (SHEAR, Mistake::Shear)];
    let found = mistakes.iter().find(|(name, _)| conditions.is(name));
    Mistaken { soil: soil(Unyielding), mistake: found.map_or(Mistake::None, |found| found.1) }
}

/// The largest component of the error, in units of the largest of the stress.
fn rotated<T: Real>(axis: &[f64; 3], angle: f64, increments: usize, conditions: &Conditions) -> f64 {
    let start = [-1700.0, -400.0, -900.0, 350.0, -120.0, 210.0];
    let mut driver = Driver::new(elastic::<T>(conditions), SoilMemory::stressed(SymTensor(start.map(T::of))));
    let [x, y, z] = axis.map(|n| T::of(n * angle));
    let leg = Leg::strain(SymTensor::zero()).turning([-z, -x, y]);
    driver.follow(&leg, increments).expect("a rotation");
    let exact = turned(&start, axis, angle);
    let found = driver.row().stress.0.map(T::as_f64);
    let differences = found.iter().zip(exact).map(|(a, b)| (a - b).abs() / 1700.0);
    differences.fold(0.0, f64::max)
}

/// R σ Rᵀ, by Rodrigues' formula.
fn turned(stress: &[f64; 6], axis: &[f64; 3], angle: f64) -> [f64; 6] {
    let [x, y, z] = *axis;
    let (sin, cos) = angle.sin_cos();
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let rotation = |a: usize, b: usize| {
        let unit = if a == b { cos } else { 0.0 };
        unit + sin * cross[a][b] + (1.0 - cos) * axis[a] * axis[b]
    };
    let at = |a: usize, b: usize| stress[SymTensor::<f64>::index(a, b)];
    let component = |a: usize, b: usize| -> f64 {
        (0..3)
            .flat_map(|c| (0..3).map(move |d| (c, d)))
            .map(|(c, d)| rotation(a, c) * at(c, d) * rotation(b, d))
            .sum()
    };
    [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|(a, b)| component(a, b))
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
