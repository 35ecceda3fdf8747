//! What the benchmarks share: the common dam break, CPU time, and how a benchmark is run.
#![allow(dead_code, reason = "each benchmark uses its part")]

use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Absent, Cone, DruckerPrager, Elasticity, LateralRatio, Soil, SoilMemory, Water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase, Wall};
use alluvium::neighbours::CellList;
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::summation::{Cloud, Neighbourhood};
use alluvium::time::StepSize;
use alluvium::{InstructionSet, Preset, Real, Vector, setup};
use cpu_time::ThreadTime;
use criterion::Criterion;
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use std::time::Duration;

/// CPU time of the one thread that runs: other programs on the machine disturb it less than a clock.
pub struct CpuTime;

impl Measurement for CpuTime {
    type Intermediate = ThreadTime;
    type Value = Duration;
    fn start(&self) -> ThreadTime {
        ThreadTime::now()
    }
    fn end(&self, start: ThreadTime) -> Duration {
        start.elapsed()
    }
    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }
    fn zero(&self) -> Duration {
        Duration::ZERO
    }
    fn to_f64(&self, value: &Duration) -> f64 {
        value.as_nanos() as f64
    }
    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

/// Runs benchmarks on one thread of the library, in short: a table within minutes, no statistics.
pub fn run(benchmarks: impl FnOnce(&mut Criterion<CpuTime>) + Send) {
    Threads::new(1).expect("a thread").install(|| {
        let mut criterion = Criterion::default()
            .with_measurement(CpuTime)
            .sample_size(10)
            .warm_up_time(Duration::from_millis(100))
            .measurement_time(Duration::from_millis(500))
            .configure_from_args();
        benchmarks(&mut criterion);
        criterion.final_summary();
    });
}

/// The instruction sets a benchmark compares: what the machine has, and one lane as the baseline.
pub fn instruction_sets() -> [InstructionSet; 2] {
    [InstructionSet::detect(), InstructionSet::at_most("scalar").expect("it exists")]
}

/// About `count` points of unit spacing, moved off a lattice by up to a fifth of it.
pub fn jittered<T: Real, const D: usize>(count: usize) -> Vec<Vector<T, D>> {
    let side = (count as f64).powf(1.0 / D as f64).round();
    let mut points = setup::fill([0.0; D], [side; D], 1.0);
    let mut seed = 1u64;
    for x in points.iter_mut().flat_map(|x| &mut x.0) {
        // Knuth's multiplier for linear congruences; the upper bits are random enough.
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *x += T::of(0.4 * ((seed >> 33) as f64 / f64::from(1u32 << 31) - 0.5));
    }
    points
}

/// Points with masses and densities one, sorted, and their neighbours at less than 2.4 spacings.
pub struct Points<T: Real, const D: usize> {
    x: Vec<Vector<T, D>>,
    ones: Vec<T>,
    neighbourhood: Neighbourhood<T, D>,
}

impl<T: Real, const D: usize> Points<T, D> {
    pub fn new(count: usize, support: T, set: InstructionSet) -> Self {
        let search = Box::<CellList<T, D>>::default();
        let mut neighbourhood =
            Neighbourhood::new(search, support).with_skin(T::ZERO).with_instruction_set(set);
        let points = jittered::<T, D>(count);
        let order = neighbourhood.cell_order(&points, 0);
        let x: Vec<_> = order.iter().map(|&i| points[i as usize]).collect();
        neighbourhood.rebuild(&x, 0);
        Self { ones: vec![T::ONE; x.len()], x, neighbourhood }
    }

    pub fn cloud<'a, K: Kernel<T, D>>(&'a self, kernel: &'a K) -> Cloud<'a, T, K, D> {
        Cloud::new(&self.neighbourhood, kernel, &self.x, &self.ones, &self.ones).expect("as it was built")
    }

    /// A field to take sums of: the first coordinate.
    pub fn field(&self) -> Vec<T> {
        self.x.iter().map(|x| x[0]).collect()
    }

    /// A vector field to take sums of: the place.
    pub fn vectors(&self) -> &[Vector<T, D>] {
        &self.x
    }
}

/// A run of sand.
pub type SandRun<T, const D: usize> = Simulation<T, D, WendlandC2<T, D>, Soil<T>, Absent>;

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;

/// A block of inviscid water in the corner of an open tank, walls of one layer on the lattice.
#[derive(Clone, Copy, Debug)]
pub struct DamBreak<const D: usize> {
    /// Its name in reports.
    pub name: &'static str,
    /// Extent of the water \[m\]; the last axis points up.
    pub water: [f64; D],
    /// Extent of the tank inside \[m\].
    pub tank: [f64; D],
    /// Particle spacing Δx \[m\].
    pub spacing: f64,
    /// h/Δx \[-\].
    pub smoothing: f64,
}

/// 12 800 water and 642 wall particles.
pub const SMALL: DamBreak<2> =
    DamBreak { name: "2D 13k h=1.0", water: [0.1, 0.2], tank: [0.4, 0.2], spacing: 0.00125, smoothing: 1.0 };
/// 204 800 water and 2 562 wall particles.
pub const LARGE: DamBreak<2> = DamBreak { name: "2D 207k h=1.0", spacing: 0.0003125, ..SMALL };
/// The same with twice the neighbours.
pub const LARGE_WIDE: DamBreak<2> = DamBreak { name: "2D 207k h=1.3", smoothing: 1.3, ..LARGE };
/// 256 000 water and 56 884 wall particles.
pub const SPACE: DamBreak<3> = DamBreak {
    name: "3D 313k h=1.2",
    water: [0.4, 0.2, 0.4],
    tank: [1.0, 0.2, 0.5],
    spacing: 0.005,
    smoothing: 1.2,
};

impl<const D: usize> DamBreak<D> {
    /// How many particles there are.
    pub fn particles(&self) -> usize {
        self.mixture::<f32>(InstructionSet::detect()).water().len()
    }

    /// The run: artificial viscosity 0.05, diffusion of the true density 0.1, Courant number 0.2.
    pub fn simulation<T: Real>(&self, set: InstructionSet) -> Simulation<T, D> {
        let step_size = StepSize::courant(T::of(0.2)).expect("a Courant number");
        Simulation::new(self.mixture(set), Preset::Default.leap_frog(), step_size)
    }

    /// The same with sand in the place of water: θ = 19.8°, ψ = 0, return mapping.
    pub fn of_sand<T: Real>(&self, set: InstructionSet) -> SandRun<T, D> {
        let elasticity = Elasticity::from_bulk(T::of(0.7e6), T::of(0.3)).expect("moduli");
        let friction = T::of(19.8_f64.to_radians());
        let cone = DruckerPrager::new(Cone::PlaneStrain, friction, T::ZERO).expect("angles");
        let ratio = LateralRatio::new(&elasticity, &cone).admissible();
        let mut sand = Phase::new(Soil::new(T::of(2650.0), elasticity, cone).expect("a soil"));
        let volume = T::of(self.spacing.powi(D as i32));
        let (walls, block) = self.places();
        sand.add_wall(Wall::dynamic(), &walls, volume, |_| T::ZERO).expect("finite");
        sand.add(&block, volume, |_| T::ZERO).expect("finite");
        let (up, height) = (D - 1, self.water[D - 1]);
        sand.set_stress(|x| {
            let depth = (height - x[up].as_f64()).clamp(0.0, height);
            SoilMemory::geostatic(T::of(-2650.0 * GRAVITY * depth), ratio, up).stress
        });
        let mixture =
            Mixture::of_soil(self.kernel(), sand).with_gravity(self.gravity()).with_instruction_set(set);
        Simulation::new(
            mixture,
            Preset::Default.leap_frog(),
            StepSize::courant(T::of(0.2)).expect("a Courant number"),
        )
    }

    fn kernel<T: Real>(&self) -> WendlandC2<T, D> {
        WendlandC2::new(T::of(self.smoothing * self.spacing)).expect("a length")
    }

    fn gravity<T: Real>(&self) -> Vector<T, D> {
        let mut gravity = [0.0; D];
        gravity[D - 1] = -GRAVITY;
        Vector::of(gravity)
    }

    /// Places of the walls and of the block.
    fn places<T: Real>(&self) -> (Vec<Vector<T, D>>, Vec<Vector<T, D>>) {
        let closed = core::array::from_fn(|axis| (true, axis + 1 != D));
        let walls = setup::tank([0.0; D], self.tank, self.spacing, 1, closed);
        (walls, setup::fill([0.0; D], self.water, self.spacing))
    }

    fn mixture<T: Real>(&self, set: InstructionSet) -> Mixture<T, D> {
        let height = self.water[D - 1];
        let sound_speed = 10.0 * (GRAVITY * height).sqrt();
        let material = Water::new(T::of(DENSITY), T::of(sound_speed)).expect("sound water");
        let volume = T::of(self.spacing.powi(D as i32));
        let pressure = setup::hydrostatic(T::of(DENSITY), T::of(GRAVITY), D - 1, T::of(height));
        let (walls, block) = self.places();
        let mut water = Phase::new(material);
        water.add_wall(Wall::dynamic(), &walls, volume, |_| T::ZERO).expect("finite");
        water.add(&block, volume, pressure).expect("finite");
        Mixture::of_water(self.kernel(), water)
            .with_gravity(self.gravity())
            .with_artificial_viscosity(ArtificialViscosity { linear: T::of(0.05), quadratic: T::ZERO })
            .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::TrueDensity(T::of(0.1))))
            .expect("sound numerics")
            .with_instruction_set(set)
    }
}
