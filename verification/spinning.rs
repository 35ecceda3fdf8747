//! A rigid rotation on top of any motion: strain, and with it density, does not see it; stress turns along.
//!
//! Seen in one evaluation: rates do not know centrifugal force. Gradients are corrected, which makes them exact for
//! a rotation, and drag acts along the line between particles.

use crate::bands::worst;
use crate::clouds::{Both, Cloud, Made, of_every_cloud};
use crate::frames::Frame;
use crate::soil::SpinningBack;
use alluvium::material::{Material, SoilMemory};
use alluvium::time::Evolve;
use alluvium::verify::{Conditions, Expected, Measured, Study};
use alluvium::{Real, SymTensor, Vector};

const BACKWARDS: &str = "spin of the sign of (66)";
const UNCORRECTED: &str = "gradients not corrected";
const ANY_LINE: &str = "drag along the slip, not along the line between the particles";

/// Angular velocity \[1/s\]: at the rim, ten times the flow.
const SPIN: f64 = 10.0;
/// Roundings of each rate: some for each neighbour.
const ROUNDINGS: f64 = 100.0;

pub fn studies() -> Vec<Study> {
    of_every_cloud!(study)
}

fn study<T: Real, const D: usize>(made: Made) -> Study {
    let cloud = Cloud::<D> { corrected: true, ..Cloud::new(made) };
    let largest = ROUNDINGS * T::EPSILON.as_f64() * (1.0 / cloud.spacing() + 10.0);
    let study = Study::new(
        format!("invariance/spin/{}/{D}d/{}", made.name(), T::NAME),
        "a rigid rotation on top of a flow changes no acceleration and no rate of density or fraction, and the \
         rate of stress by ωσ − σω (values: differences over the largest rate)",
        move |conditions| compare::<T, D>(cloud, conditions),
    )
    .equations(&["33", "34", "35", "52", "53", "55", "58", "65", "66", "69"])
    .source("objectivity; bar: a hundred roundings of pairs Δx apart at L, of velocities that differ by u at ΩL")
    .expect(Expected::Bound { largest })
    .mutant(UNCORRECTED);
    let study = if made.has_soil() { study.mutant(BACKWARDS) } else { study };
    if made == Made::Mixture { study.mutant(ANY_LINE) } else { study }
}

/// ω of v = ω x: in three dimensions about an oblique axis.
fn spin<const D: usize>() -> [[f64; 3]; 3] {
    let [xy, yz, xz] = if D == 3 { [0.8, 0.5, -0.33] } else { [1.0, 0.0, 0.0] };
    [[0.0, xy, xz], [-xy, 0.0, yz], [-xz, -yz, 0.0]].map(|row| row.map(|w| SPIN * w))
}

/// Rates by particle: acceleration, density, fraction, stress.
struct Rates<const D: usize> {
    of: &'static str,
    acceleration: Vec<[f64; D]>,
    density: Vec<f64>,
    fraction: Vec<f64>,
    stress: Vec<SymTensor<f64>>,
    /// What a spin adds to the last.
    turning: Vec<SymTensor<f64>>,
}

fn compare<T: Real, const D: usize>(cloud: Cloud<D>, conditions: &Conditions) -> Measured {
    let still = rates::<T, D, _>(cloud, Cloud::<D>::soil(), 0.0, conditions);
    let spun = match conditions.is(BACKWARDS) {
        true => rates::<T, D, _>(cloud, SpinningBack(Cloud::<D>::soil()), 1.0, conditions),
        false => rates::<T, D, _>(cloud, Cloud::<D>::soil(), 1.0, conditions),
    };
    let mut values = Vec::new();
    for (a, b) in still.iter().zip(&spun) {
        let vector = |v: &Vec<[f64; D]>| v.iter().flatten().copied().collect::<Vec<f64>>();
        let tensor = |t: &Vec<SymTensor<f64>>| t.iter().flat_map(|t| t.0).collect::<Vec<f64>>();
        let (rate, turning) = (tensor(&a.stress), tensor(&a.turning));
        let turned: Vec<f64> = rate.iter().zip(&turning).map(|(x, y)| x + y).collect();
        let pairs = [
            ("accelerations", vector(&a.acceleration), vector(&b.acceleration)),
            ("densities", a.density.clone(), b.density.clone()),
            ("fractions", a.fraction.clone(), b.fraction.clone()),
            ("stresses", turned, tensor(&b.stress)),
        ];
        for (what, expected, found) in pairs {
            let size = worst(expected.iter().map(|x| x.abs()));
            let off = worst(expected.iter().zip(&found).map(|(a, b)| (b - a).abs()));
            // What has no rate of this kind must not get one.
            if size > 0.0 || off != 0.0 {
                values.push((format!("{what} of {}", a.of), off / size));
            }
        }
    }
    Measured::values(values)
}

fn rates<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    cloud: Cloud<D>,
    law: S,
    part: f64,
    conditions: &Conditions,
) -> [Rates<D>; 2] {
    let cloud = Cloud { corrected: !conditions.is(UNCORRECTED), ..cloud };
    let mixture = cloud.mixture::<T, S>(law, &Frame::own(), None);
    let mut mixture: Both<T, D, S> =
        if conditions.is(ANY_LINE) { mixture } else { mixture.with_projected_drag() };
    let omega = spin::<D>();
    let added = |x: &Vector<T, D>| {
        let x = x.as_f64();
        Vector::of(core::array::from_fn(|a| part * (0..D).map(|b| omega[a][b] * x[b]).sum::<f64>()))
    };
    mixture.soil_mut().add_velocity(added);
    mixture.water_mut().add_velocity(added);
    mixture.evaluate().expect("rates");
    let (soil, water) = (mixture.soil(), mixture.water());
    let turning = |i: usize| {
        let stress = SymTensor(soil.memory(i).stress.0.map(T::as_f64));
        stress.turning(&[omega[0][1], omega[1][2], omega[0][2]])
    };
    [
        Rates {
            of: "soil",
            acceleration: soil.accelerations().iter().map(Vector::as_f64).collect(),
            density: (0..soil.len()).map(|i| soil.density_rate(i).as_f64()).collect(),
            fraction: Vec::new(),
            stress: (0..soil.len()).map(|i| SymTensor(soil.memory_rate(i).stress.0.map(T::as_f64))).collect(),
            turning: (0..soil.len()).map(turning).collect(),
        },
        Rates {
            of: "water",
            acceleration: water.accelerations().iter().map(Vector::as_f64).collect(),
            density: (0..water.len()).map(|a| water.density_rate(a).as_f64()).collect(),
            fraction: (0..water.len()).map(|a| water.fraction_rate(a).as_f64()).collect(),
            stress: Vec::new(),
            turning: Vec::new(),
        },
    ]
}
