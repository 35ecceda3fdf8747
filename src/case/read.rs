//! A case file's tables, one function each.

use super::bounds::{finite, from_to, positive};
use super::choice::{DiffusionKind, Field, InitialPressure, Precision, Preset, SearchChoice, Slip, WallKind};
use super::model::{
    Block, Case, Dumps, Gauge, MovingWall, Neighbours, Output, Particles, StepSize, Tank, Time, Walls, Water,
};
use super::preset::{Defaults, defaults};
use super::reader::Reader;
use super::section::Section;

const NAME: &str = "letters, digits, - and _ (it names files)";
const FAR: f64 = 1e7;

/// What the tables are read with: the problems' home, the defaults, the dimension.
pub(super) struct Context<'a, 's> {
    pub(super) reader: &'a Reader<'s>,
    pub(super) defaults: Defaults,
    pub(super) dimension: usize,
}

/// The whole file.
pub(super) fn case(reader: &Reader<'_>, root: &Section<'_, '_>) -> Case {
    let preset = root.choice("preset").unwrap_or(Preset::Default);
    let dimension = root.count("dimension", 2..=3).unwrap_or(2) as usize;
    let context = Context { reader, defaults: defaults(preset), dimension };
    let up = [0.0, -9.81, 0.0];
    let gravity = root
        .numbers("gravity_m_per_s2", Some(dimension), from_to(-1e6, 1e6, "m/s²"))
        .unwrap_or_else(|| up[..dimension].to_vec());
    let end_time = root.required_number("end_time_s", positive(1e9, "s"));
    let particles = context.particles(&root.section("particles"));
    let tank = context.tank(&root.section("tank"), &particles);
    let periodic = root.section("periodic");
    let case = Case {
        name: context.file_name(root, "name"),
        preset,
        dimension,
        precision: root.choice("precision").unwrap_or(Precision::F64),
        threads: root.count("threads", 0..=4096).unwrap_or(0) as usize,
        end_time,
        water: context.water(&root.section("water"), &gravity, tank.as_ref()),
        gravity,
        particles,
        tank,
        periodic: periodic.choices("axes").unwrap_or_default(),
        time: context.time(&root.section("time")),
        neighbours: context.neighbours(&root.section("neighbours")),
        output: context.output(&root.section("output"), end_time),
        gauges: root.sections("gauge").iter().map(|gauge| context.gauge(gauge)).collect(),
    };
    periodic.finish();
    root.finish();
    case
}

impl Context<'_, '_> {
    fn file_name(&self, section: &Section<'_, '_>, key: &'static str) -> String {
        let name = section.required_text(key, NAME);
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if name.is_empty() || name.len() > 100 || !name.chars().all(fits) {
            self.reader.error(&section.name(key), "cannot name a file", NAME);
        }
        name
    }

    fn particles(&self, section: &Section<'_, '_>) -> Particles {
        let particles = Particles {
            spacing: section.required_number("spacing_m", positive(1e4, "m")),
            smoothing_ratio: section
                .number("smoothing_ratio", from_to(1.0, 4.0, "h/Δx; below 1 there are too few neighbours"))
                .unwrap_or(self.defaults.smoothing_ratio),
            kernel: section.choice("kernel").unwrap_or(self.defaults.kernel),
        };
        section.finish();
        particles
    }

    fn water(&self, section: &Section<'_, '_>, gravity: &[f64], tank: Option<&Tank>) -> Water {
        let viscosity = section.section("artificial_viscosity");
        let (linear, quadratic) = self.defaults.artificial_viscosity;
        let (diffusion, diffusion_coefficient) = self.diffusion(&section.section("density_diffusion"));
        let reinitialisation = section.section("reinitialisation");
        let every = reinitialisation.count("every_steps", 0..=1_000_000_000);
        let sound_speed = section.number("sound_speed_m_per_s", positive(1e5, "m/s"));
        let blocks: Vec<Block> =
            section.sections("block").iter().map(|block| self.block(block, gravity)).collect();
        if blocks.is_empty() && !self.reader.given(&section.name("block")) {
            self.reader.missing(
                "water",
                "block",
                "at least one [[water.block]] with low_m and high_m".into(),
            );
        }
        let water = Water {
            reference_density: section
                .number("reference_density_kg_per_m3", from_to(1.0, 1e5, "kg/m³"))
                .unwrap_or(1000.0),
            sound_speed: sound_speed.unwrap_or_else(|| self.sound_speed(&blocks, gravity, tank)),
            viscosity: section.number("viscosity_pa_s", from_to(0.0, 1e6, "Pa s")).unwrap_or(1e-3),
            tait_exponent: section.number("tait_exponent", from_to(1.0, 15.0, "")).unwrap_or(7.0),
            artificial_viscosity_linear: viscosity.number("linear", from_to(0.0, 10.0, "")).unwrap_or(linear),
            artificial_viscosity_quadratic: viscosity
                .number("quadratic", from_to(0.0, 10.0, ""))
                .unwrap_or(quadratic),
            diffusion,
            diffusion_coefficient,
            reinitialisation_every: every.unwrap_or(self.defaults.reinitialisation_every),
            blocks,
        };
        [&viscosity, &reinitialisation, section].iter().for_each(|section| section.finish());
        water
    }

    fn diffusion(&self, section: &Section<'_, '_>) -> (DiffusionKind, f64) {
        let kind = section.choice("kind").unwrap_or(self.defaults.diffusion);
        let coefficient = section.number("coefficient", from_to(0.0, 1.0, ""));
        section.finish();
        if kind == DiffusionKind::None {
            if coefficient.is_some() {
                let name = section.name("coefficient");
                self.reader.warning(
                    &name,
                    "has no effect: kind is \"none\"",
                    "leave it out, or choose a kind",
                );
            }
            return (kind, 0.0);
        }
        (kind, coefficient.unwrap_or(self.defaults.diffusion_coefficient))
    }

    fn block(&self, section: &Section<'_, '_>, gravity: &[f64]) -> Block {
        let d = self.dimension;
        let low = section.required_numbers("low_m", d, from_to(-FAR, FAR, "m"));
        let high = section.required_numbers("high_m", d, from_to(-FAR, FAR, "m"));
        let velocity = section.numbers("velocity_m_per_s", Some(d), from_to(-1e5, 1e5, "m/s"));
        let weightless = gravity.iter().all(|g| *g == 0.0);
        let rest = if weightless { InitialPressure::Zero } else { InitialPressure::Hydrostatic };
        let initial_pressure = section.choice("initial_pressure").unwrap_or(rest);
        let surface = section.number("surface_m", finite("m"));
        section.finish();
        Block {
            surface: surface.unwrap_or_else(|| highest(&low, &high, gravity)),
            velocity: velocity.unwrap_or_else(|| vec![0.0; d]),
            low,
            high,
            initial_pressure,
        }
    }

    /// Ten times the fastest speed to expect: of the blocks, and of a fall from the highest water to the
    /// lowest point.
    fn sound_speed(&self, blocks: &[Block], gravity: &[f64], tank: Option<&Tank>) -> f64 {
        let speed = expected_speed(blocks, gravity, tank);
        if speed > 0.0 {
            return 10.0 * speed;
        }
        if !self.reader.has_errors() {
            let allowed = "a number above 0.0 [m/s], ten times the fastest speed to expect".to_owned();
            self.reader.missing("water", "sound_speed_m_per_s", allowed);
        }
        1.0
    }

    fn tank(&self, section: &Section<'_, '_>, particles: &Particles) -> Option<Tank> {
        if !section.is_given() {
            return None;
        }
        let d = self.dimension;
        let walls = self.walls(section);
        let support = particles.kernel.support_ratio() * particles.smoothing_ratio;
        let enough = self.defaults.layers.unwrap_or_else(|| (support - 1e-9).ceil() as u64);
        let tank = Tank {
            low: section.required_numbers("low_m", d, from_to(-FAR, FAR, "m")),
            high: section.required_numbers("high_m", d, from_to(-FAR, FAR, "m")),
            open: section.choices("open").unwrap_or_default(),
            walls,
            layers: section.count("layers", 1..=20).unwrap_or(enough),
            moving: section.sections("moving").iter().map(|wall| self.moving(wall)).collect(),
        };
        section.finish();
        Some(tank)
    }

    fn walls(&self, section: &Section<'_, '_>) -> Walls {
        let slip = section.choice("slip");
        match section.choice("walls").unwrap_or(self.defaults.walls) {
            WallKind::Extrapolated => Walls::Extrapolated(slip.unwrap_or(Slip::FreeSlip)),
            WallKind::Dynamic => {
                if slip.is_some() {
                    let why = "has no effect: dynamic walls have no choice of slip";
                    let allowed = "leave it out, or walls = \"extrapolated\"";
                    self.reader.warning(&section.name("slip"), why, allowed);
                }
                Walls::Dynamic
            }
        }
    }

    fn moving(&self, section: &Section<'_, '_>) -> MovingWall {
        let side = section.choice("side");
        if side.is_none() && !self.reader.given(&section.name("side")) {
            let table = section.name("").trim_end_matches('.').to_owned();
            self.reader.missing(&table, "side", "a side of the tank, as in \"+y\"".into());
        }
        let velocity =
            section.required_numbers("velocity_m_per_s", self.dimension, from_to(-1e5, 1e5, "m/s"));
        section.finish();
        MovingWall { side: side.unwrap_or(super::choice::Side::LowX), velocity }
    }

    fn time(&self, section: &Section<'_, '_>) -> Time {
        let courant = section.number("courant", positive(1.0, "c Δt/h"));
        let fixed = section.number("time_step_s", positive(1e6, "s"));
        if courant.is_some() && fixed.is_some() {
            let name = section.name("time_step_s");
            self.reader.error(&name, "contradicts courant", "either courant or time_step_s");
        }
        let courant = courant.unwrap_or(self.defaults.courant);
        let time = Time {
            integrator: section.choice("integrator").unwrap_or(self.defaults.integrator),
            step: fixed.map_or(StepSize::Courant(courant), StepSize::Fixed),
        };
        section.finish();
        time
    }

    fn neighbours(&self, section: &Section<'_, '_>) -> Neighbours {
        let neighbours = Neighbours {
            search: section.choice("search").unwrap_or(SearchChoice::CellList),
            skin_ratio: section.number("skin_ratio", from_to(0.0, 1.0, "over the support")).unwrap_or(0.1),
        };
        section.finish();
        neighbours
    }

    fn output(&self, section: &Section<'_, '_>, end_time: f64) -> Output {
        let every = section.number("dump_interval_s", positive(1e9, "s"));
        let at = section.numbers("dump_times_s", None, from_to(0.0, 1e9, "s"));
        if every.is_some() && at.is_some() {
            let name = section.name("dump_times_s");
            self.reader.error(&name, "contradicts dump_interval_s", "either dump_interval_s or dump_times_s");
        }
        let standard = || vec![Field::Velocity, Field::Pressure, Field::Density];
        let output = Output {
            dumps: at.map_or_else(|| Dumps::Every(every.unwrap_or(end_time / 50.0)), Dumps::At),
            history_interval: section
                .number("history_interval_s", from_to(0.0, 1e9, "s"))
                .unwrap_or(end_time / 1000.0),
            fields: section.choices("fields").unwrap_or_else(standard),
        };
        section.finish();
        output
    }

    fn gauge(&self, section: &Section<'_, '_>) -> Gauge {
        let quantity = section.choice("quantity").unwrap_or(super::choice::Quantity::Pressure);
        let gauge = Gauge {
            name: self.file_name(section, "name"),
            position: section.required_numbers("position_m", self.dimension, from_to(-FAR, FAR, "m")),
            quantity,
        };
        section.finish();
        gauge
    }
}

/// Height of a box's highest corner, measured against gravity \[m\].
fn highest(low: &[f64], high: &[f64], gravity: &[f64]) -> f64 {
    let strength = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    if strength == 0.0 {
        return 0.0;
    }
    let along = |k: usize| (-gravity[k] / strength * low[k]).max(-gravity[k] / strength * high[k]);
    (0..gravity.len()).map(along).sum()
}

/// The fastest speed to expect \[m/s\]: of the blocks, and of a fall to the lowest point.
pub(super) fn expected_speed(blocks: &[Block], gravity: &[f64], tank: Option<&Tank>) -> f64 {
    let strength = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let down: Vec<f64> = gravity.iter().map(|g| -g).collect();
    let top = blocks.iter().map(|b| highest(&b.low, &b.high, gravity)).fold(f64::MIN, f64::max);
    let boxes = blocks.iter().map(|b| (&b.low, &b.high)).chain(tank.map(|t| (&t.low, &t.high)));
    let bottom = boxes.map(|(low, high)| -highest(low, high, &down)).fold(f64::MAX, f64::min);
    let fall = (2.0 * strength * (top - bottom).max(0.0)).sqrt();
    let own = blocks.iter().map(|b| b.velocity.iter().map(|v| v * v).sum::<f64>().sqrt());
    own.fold(fall, f64::max)
}
