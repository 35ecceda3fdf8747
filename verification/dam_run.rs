//! Runs of the dam break, each done once and shared by the studies that read it.

use crate::scene::Tank;
use crate::shared_runs::SharedRuns;
use alluvium::budget::Account;
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Wall};
use alluvium::output::Table;
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::StepSize;
use alluvium::verify::Conditions;
use alluvium::verify::dam_break::{self, Curve, Reference};
use alluvium::{Preset, Real, Vector};
use std::ops::ControlFlow;
use std::sync::OnceLock;

pub const LIGHT: &str = "gravity of 8 m/s²";
pub const HEAVY: &str = "gravity of 14 m/s²";
pub const UNDAMPED: &str = "neither artificial viscosity nor density diffusion";
pub const THIN: &str = "walls of every third particle";
pub const UNBOOKED: &str = "artificial viscosity left out of the ledger";

const VOLUME_OF_FLUID: &str = include_str!("data/dam_break_vof_u_t0.200.csv");
/// Cell of the finite-volume solution \[m\].
const CELL: f64 = 0.00125;

/// What one run shows.
#[derive(Clone, Debug, Default)]
pub struct Record {
    pub front: Curve,
    /// Pressure noise at t = 0.1 and 0.2 s \[-\].
    pub noise: Vec<f64>,
    /// Largest energy closure over the initial potential energy \[-\], and when \[s\].
    pub closure: f64,
    pub open_at: f64,
    /// Most particles through the walls, or hanging at the left one, at any time.
    pub leaked: usize,
    pub stuck: usize,
    /// How far the farthest ever was behind the face of a wall \[spacings\].
    pub deepest: f64,
    /// L₂ error (78) at t = 0.2 s, over how many particles, and how many were left out.
    pub error: f64,
    pub compared: usize,
    pub left_out: usize,
}

/// The run of a preset at a spacing \[m\] to time `end` \[s\].
pub fn record<T: Real>(preset: Preset, spacing: f64, end: f64, conditions: &Conditions) -> Record {
    static RUNS: SharedRuns<Record> = SharedRuns::new();
    let key = format!("{} {preset:?} {spacing} {end} {:?}", T::NAME, conditions.mutant);
    RUNS.get(key, || run::<T>(preset, spacing, end, conditions))
}

/// The paper's is fixed (Table 1).
fn step_size<T: Real>(preset: Preset, spacing: f64) -> StepSize<T> {
    let step = match preset {
        Preset::Paper => StepSize::fixed(T::of(dam_break::step(spacing))),
        Preset::Default => StepSize::courant(T::of(preset.courant())),
    };
    step.expect("in range")
}

fn run<T: Real>(preset: Preset, spacing: f64, end: f64, conditions: &Conditions) -> Record {
    let scene = Tank::dam_break(spacing, preset);
    let mixture = mutated(scene.mixture::<T>(preset.wall()), conditions);
    let run = Simulation::new(mixture, preset.leap_frog(), step_size(preset, spacing))
        .with_reinitialisation(preset.reinitialise_every());
    // One thread each: the harness runs studies side by side.
    Threads::new(1).expect("a thread").install(|| watch(run, end, conditions))
}

/// The front of a 3D slab of the default preset.
pub fn slab_record(spacing: f64, depth: f64, conditions: &Conditions) -> Record {
    let scene = Tank::dam_break_slab(spacing, depth, Preset::Default);
    let mixture = mutated(scene.mixture::<f64>(Preset::Default.wall()), conditions);
    let run = Simulation::new(mixture, Preset::Default.leap_frog(), step_size(Preset::Default, spacing));
    Threads::new(1).expect("a thread").install(|| watch(run, 0.18, conditions))
}

/// A run whose ledger is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Closing {
    pub preset: Preset,
    /// \[m\]
    pub spacing: f64,
    /// Dynamic walls, whatever the preset has.
    pub dynamic: bool,
    pub courant: f64,
    /// Steps between reinitialisations (70); 0 means never.
    pub reinitialise_every: usize,
}

/// Where runs end whose ledger is looked at \[s\]: the water has run up the far wall and falls back.
const LEDGER_END: f64 = 0.5;

impl Closing {
    pub fn run(self, conditions: &Conditions) -> Record {
        static RUNS: SharedRuns<Record> = SharedRuns::new();
        RUNS.get(format!("{self:?} {:?}", conditions.mutant), || self.run_anew(conditions))
    }

    fn run_anew(self, conditions: &Conditions) -> Record {
        let wall = if self.dynamic { Wall::dynamic() } else { self.preset.wall() };
        let scene = Tank::dam_break(self.spacing, self.preset);
        // Single drops come as high as 1.2 m.
        let scene = Tank { tank: [scene.tank[0], 8.0 * dam_break::HEIGHT], ..scene };
        let mixture = scene.mixture_without::<f64>(wall, &|k| conditions.is(THIN) && k % 3 != 0);
        let step_size = StepSize::courant(self.courant).expect("up to one");
        let run = Simulation::new(mixture, self.preset.leap_frog(), step_size)
            .with_reinitialisation(self.reinitialise_every);
        Threads::new(1).expect("a thread").install(|| watch(run, LEDGER_END, conditions))
    }
}

fn mutated<T: Real, const D: usize>(mixture: Mixture<T, D>, conditions: &Conditions) -> Mixture<T, D> {
    let down = |g: f64| {
        let mut gravity = [0.0; D];
        gravity[1] = -g;
        Vector::of(gravity)
    };
    if conditions.is(LIGHT) {
        return mixture.with_gravity(down(8.0));
    }
    if conditions.is(HEAVY) {
        return mixture.with_gravity(down(14.0));
    }
    if conditions.is(UNDAMPED) {
        let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
        return mixture
            .with_artificial_viscosity(none)
            .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
            .expect("in range");
    }
    mixture
}

fn watch<T: Real, const D: usize>(mut run: Simulation<T, D>, end: f64, conditions: &Conditions) -> Record {
    let mut record = Record::default();
    let mut start = None;
    for stop in [0.1, 0.2, end].into_iter().filter(|&stop| stop <= end) {
        let outcome = run.run_until(stop, |run| {
            let start = *start.get_or_insert_with(|| run.budget());
            if run.steps() % 20 == 0 || run.time() == stop {
                record.front.push(dam_break::dimensionless_time(run.time()), dam_break::front(run.mixture()));
                let mut now = run.budget();
                if conditions.is(UNBOOKED) {
                    now.taken[Account::ArtificialViscosity] = 0.0;
                }
                let open = (now.closure(&start) / start.potential).abs();
                if open > record.closure {
                    (record.closure, record.open_at) = (open, run.time());
                }
                record.leaked = record.leaked.max(dam_break::leaked(run.mixture()));
                record.stuck = record.stuck.max(dam_break::stuck(run.mixture()));
                record.deepest = record.deepest.max(dam_break::deepest(run.mixture()));
            }
            ControlFlow::Continue(())
        });
        if outcome.is_err() {
            return Record {
                leaked: usize::MAX,
                closure: f64::INFINITY,
                noise: vec![f64::INFINITY; 2],
                error: f64::INFINITY,
                ..record
            };
        }
        if stop < 0.21 && record.noise.len() < 2 {
            look(&run, &mut record);
        }
    }
    record
}

fn look<T: Real, const D: usize>(run: &Simulation<T, D>, record: &mut Record) {
    record.noise.push(dam_break::pressure_noise(run.mixture()).0);
    let error = reference().velocity_error(run.mixture());
    (record.error, record.compared, record.left_out) = (error.l2, error.compared, error.left_out);
}

fn reference() -> &'static Reference {
    static REFERENCE: OnceLock<Reference> = OnceLock::new();
    REFERENCE.get_or_init(|| {
        let table = Table::parse(VOLUME_OF_FLUID).expect("a sound table");
        let column = |name| table.column(name).expect("a column of numbers");
        let (x, y, u, v) = (column("x"), column("y"), column("ux"), column("uy"));
        Reference::new((0..x.len()).map(|k| [x[k], y[k], u[k], v[k]]), CELL)
    })
}

/// A published curve: two columns, time and position.
pub fn published(text: &str) -> Curve {
    let table = Table::parse(text).expect("a sound table");
    let column = |k: usize| table.column(&table.columns()[k]).expect("a column of numbers");
    Curve::new(column(0).into_iter().zip(column(1)).collect())
}
