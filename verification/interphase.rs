//! A kernel of its own between soil and water: every sum against the same one over all pairs, written out.

use crate::balance::random;
use crate::soil::elastic;
use crate::water::{periodic, water};
use alluvium::kernel::{Kernel, WendlandC2, WendlandC4};
use alluvium::material::{Conductivity, Darcy, Soil, Unyielding, Water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase};
use alluvium::time::Evolve;
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, Study};
use alluvium::{Real, Vector};

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

const CONDUCTIVITY: f64 = 0.05;
/// Smoothing lengths within and between soil and water, in spacings.
const WITHIN: f64 = 1.3;
const BETWEEN: f64 = 1.9;
/// The sums, and what each is mistaken for: that with the kernel within soil and water.
const FRACTION: &str = "volume fraction with the kernel within";
const PRESSURE: &str = "mean pore pressure with the kernel within";
const EXPANSION: &str = "expansion of the water with the kernel within";
const FORCE: &str = "pressure force with the kernel within";
const COMPRESSION: &str = "density rate with the kernel within";
const DRAG: &str = "drag with the kernel within";
const OWN: &str = "pairs of water with the kernel between";

pub fn studies() -> Vec<Study> {
    vec![
        sums::<f64, 2>("interphase kernel/sums/2d/f64", 1e-12),
        sums::<f64, 3>("interphase kernel/sums/3d/f64", 1e-12),
        sums::<f32, 2>("interphase kernel/sums/2d/f32", 1e-4),
        sums::<f32, 3>("interphase kernel/sums/3d/f32", 1e-4),
    ]
}

fn sums<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    let mistakes = [FRACTION, PRESSURE, EXPANSION, FORCE, COMPRESSION, DRAG, OWN];
    let study = Study::new(
        name,
        "with another kernel between soil and water, fractions, pore pressure, drag and what the density feels are \
         summed with it, and nothing else is (values: largest difference from the sums over all pairs, over the \
         largest of them)",
        compared::<T, D>,
    )
    .equations(&["37", "52", "55", "58", "67", "68", "69"])
    .source("the formulas of docs/decisions/0013-coupling.md, term by term in f64")
    .expect(Expected::Bound { largest });
    mistakes.into_iter().fold(study, Study::mutant)
}

/// Soil and water anywhere in a box that repeats itself, with no other forces than those of pressure and drag.
fn cloud<T: Real, const D: usize>() -> Both<T, D> {
    let arranged = |seed| Arrangement::<D>::jittered(if D == 2 { 16 } else { 9 }, 0.25, seed);
    let (grains, pores) = (arranged(1), arranged(2));
    let (spacing, volume) = (grains.spacing, T::of(grains.volume));
    let velocity =
        |salt: u64| move |x: &Vector<T, D>| Vector::of(core::array::from_fn(|k| random(x, salt + k as u64)));
    let mut soil = Phase::new(elastic::<T>());
    soil.add(&grains.positions(), volume, |_| T::ZERO).expect("particles");
    soil.set_volume_fraction(|x| T::of(0.5 + 0.1 * random(x, 3)));
    soil.set_velocity(velocity(21));
    let mut fluid = Phase::new(water::<T>(10.0, 0.0));
    fluid.add(&pores.positions(), volume, |x| T::of(3e3 * random(x, 5))).expect("particles");
    fluid.set_velocity(velocity(31));
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    Mixture::new(WendlandC2::new(T::of(WITHIN * spacing)).expect("a length"), soil, fluid)
        .with_periodic(periodic([1.0; D]))
        .with_drag(Darcy::new(Conductivity::new(T::of(CONDUCTIVITY)).expect("a conductivity")))
        .with_artificial_viscosity(none)
        .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
        .and_then(|mixture| {
            mixture.with_interphase_kernel(WendlandC4::new(T::of(BETWEEN * spacing)).expect("a length"))
        })
        .expect("numerics")
}

fn compared<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let mut mixture = cloud::<T, D>();
    mixture.evaluate().expect("rates");
    let (soil, water) = (mixture.soil(), mixture.water());
    let sums = WrittenOut::of(&mixture, conditions);
    let scalars =
        |value: &dyn Fn(usize) -> T| (0..water.len()).map(|a| [value(a).as_f64()]).collect::<Vec<_>>();
    let vectors = |values: &[Vector<T, D>]| values.iter().map(|x| x.as_f64()).collect::<Vec<_>>();
    Measured::values([
        ("fraction", apart(&sums.fraction, &scalars(&|a| water.volume_fraction(a)))),
        ("rate of the fraction", apart(&sums.fraction_rate, &scalars(&|a| water.fraction_rate(a)))),
        ("rate of the density", apart(&sums.density_rate, &scalars(&|a| water.density_rate(a)))),
        ("acceleration of water", apart(&sums.of_water, &vectors(water.accelerations()))),
        ("acceleration of soil", apart(&sums.of_soil, &vectors(soil.accelerations()))),
    ])
}

/// The largest difference over the largest number.
fn apart<const N: usize>(expected: &[[f64; N]], found: &[[f64; N]]) -> f64 {
    let size = expected.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let differences = expected.iter().flatten().zip(found.iter().flatten()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / size
}

/// One particle.
struct Particle<const D: usize> {
    x: [f64; D],
    v: [f64; D],
    volume: f64,
    /// w = V φ of soil, p of water.
    own: f64,
}

/// Which kernel each part of the sums is written out with.
struct Kernels<'a, const D: usize> {
    within: WendlandC2<f64, D>,
    between: WendlandC4<f64, D>,
    conditions: &'a Conditions<'a>,
}

impl<const D: usize> Kernels<'_, D> {
    /// W and W′/r of a part between soil and water.
    fn of(&self, part: &str, r2: f64) -> [f64; 2] {
        match self.conditions.is(part) {
            true => [self.within.value(r2), self.within.slope(r2)],
            false => [self.between.value(r2), self.between.slope(r2)],
        }
    }

    /// W′/r of a pair of water.
    fn of_water(&self, r2: f64) -> f64 {
        if self.conditions.is(OWN) { self.between.slope(r2) } else { self.within.slope(r2) }
    }

    /// p_i and D_i.
    fn pores(&self, i: &Particle<D>, water: &[Particle<D>]) -> [f64; 2] {
        let [mut around, mut pressure, mut all, mut expansion] = [0.0; 4];
        for a in water {
            let (x, v) = from(i, a);
            let [weight, _] = self.of(PRESSURE, dot(x, x));
            around += a.volume * weight;
            pressure += a.volume * a.own * weight;
            let [weight, slope] = self.of(EXPANSION, dot(x, x));
            all += a.volume * weight;
            expansion += a.volume * slope * dot(v, x);
        }
        [pressure / around, expansion / all]
    }
}

/// All sums over all pairs; of accelerations first the forces.
struct WrittenOut<const D: usize> {
    fraction: Vec<[f64; 1]>,
    fraction_rate: Vec<[f64; 1]>,
    density_rate: Vec<[f64; 1]>,
    of_water: Vec<[f64; D]>,
    of_soil: Vec<[f64; D]>,
}

impl<const D: usize> WrittenOut<D> {
    fn of<T: Real>(mixture: &Both<T, D>, conditions: &Conditions<'_>) -> Self {
        let spacing = mixture.kernel().smoothing_length().as_f64() / WITHIN;
        let within = WendlandC2::new(WITHIN * spacing).expect("a length");
        let between = WendlandC4::new(BETWEEN * spacing).expect("a length");
        let kernels = Kernels { within, between, conditions };
        let (soil, water) = particles(mixture);
        let pores: Vec<_> = soil.iter().map(|i| kernels.pores(i, &water)).collect();
        let mut sums = Self {
            fraction: vec![[1.0]; water.len()],
            fraction_rate: vec![[0.0]; water.len()],
            density_rate: vec![[0.0]; water.len()],
            of_water: vec![[0.0; D]; water.len()],
            of_soil: vec![[0.0; D]; soil.len()],
        };
        for n in 0..water.len() {
            sums.add_own_pairs(&kernels, &water, n);
            sums.add_coupling(&kernels, (&soil, &pores), &water[n], n);
            let density = mixture.water().true_density(n).as_f64();
            sums.density_rate[n][0] *= density; // (52)
            sums.add_drag(&kernels, &soil, (&water[n], density), n);
        }
        let over = |forces: &mut [[f64; D]], masses: &[T]| {
            for (force, mass) in forces.iter_mut().zip(masses) {
                *force = force.map(|f| f / mass.as_f64());
            }
        };
        over(&mut sums.of_water, mixture.water().masses());
        over(&mut sums.of_soil, mixture.soil().masses());
        sums
    }

    /// (52), (58) between water particle `n` and the others.
    fn add_own_pairs(&mut self, kernels: &Kernels<'_, D>, water: &[Particle<D>], n: usize) {
        let a = &water[n];
        for b in water {
            let (x, v) = from(b, a);
            let slope = kernels.of_water(dot(x, x));
            self.density_rate[n][0] += b.volume * slope * dot(v, x);
            add(&mut self.of_water[n], x, -a.volume * b.volume * (a.own + b.own) * slope);
        }
    }

    /// (52), (55), (58), (68), (69) between water particle `n` and soil, of which p_i and D_i are known.
    fn add_coupling(
        &mut self,
        kernels: &Kernels<'_, D>,
        (soil, pores): (&[Particle<D>], &[[f64; 2]]),
        a: &Particle<D>,
        n: usize,
    ) {
        for (m, (i, [pressure, expansion])) in soil.iter().zip(pores).enumerate() {
            let (x, v) = from(i, a);
            let r2 = dot(x, x);
            let [weight, slope] = kernels.of(FRACTION, r2);
            self.fraction[n][0] -= i.own * weight;
            self.fraction_rate[n][0] -= i.own * slope * dot(v, x);
            self.density_rate[n][0] -= i.own * kernels.of(COMPRESSION, r2)[0] * expansion;
            let push = a.volume * i.own * (pressure - a.own) * kernels.of(FORCE, r2)[1];
            add(&mut self.of_water[n], x, push);
            add(&mut self.of_soil[m], x, -push);
        }
    }

    /// (37) between soil and water particle `n` of a true density.
    fn add_drag(
        &mut self,
        kernels: &Kernels<'_, D>,
        soil: &[Particle<D>],
        (a, density): (&Particle<D>, f64),
        n: usize,
    ) {
        let resistance = self.fraction[n][0].powi(2) * density * 9.81 / CONDUCTIVITY;
        for (m, i) in soil.iter().enumerate() {
            let (x, v) = from(i, a);
            let drag = a.volume * i.volume * resistance * kernels.of(DRAG, dot(x, x))[0];
            add(&mut self.of_water[n], v, -drag);
            add(&mut self.of_soil[m], v, drag);
        }
    }
}

/// Soil and water.
fn particles<T: Real, const D: usize>(mixture: &Both<T, D>) -> (Vec<Particle<D>>, Vec<Particle<D>>) {
    let (soil, water) = (mixture.soil(), mixture.water());
    let grains = |i: usize| {
        let volume = soil.volume(i).as_f64();
        let own = volume * soil.volume_fraction(i).as_f64();
        Particle { x: soil.positions()[i].as_f64(), v: soil.velocities()[i].as_f64(), volume, own }
    };
    let drops = |a: usize| Particle {
        x: water.positions()[a].as_f64(),
        v: water.velocities()[a].as_f64(),
        volume: water.volume(a).as_f64(),
        own: water.pressures()[a].as_f64(),
    };
    ((0..soil.len()).map(grains).collect(), (0..water.len()).map(drops).collect())
}

/// Where and how fast `a` is from `b`, the nearest of its images in the unit box.
fn from<const D: usize>(b: &Particle<D>, a: &Particle<D>) -> ([f64; D], [f64; D]) {
    let nearest = |x: f64| x - x.round();
    (core::array::from_fn(|k| nearest(a.x[k] - b.x[k])), core::array::from_fn(|k| a.v[k] - b.v[k]))
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add<const D: usize>(sum: &mut [f64; D], x: [f64; D], factor: f64) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += factor * x;
    }
}
