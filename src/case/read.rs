//! A case file's tables, one function each.

mod drag;
mod mixing;
mod soil;
mod tank;
mod water;

pub(super) use water::expected_speed;

use super::bounds::{from_to, positive};
use super::choice::{Field, Precision, SearchChoice};
use super::model::{Case, Dumps, Gauge, InterphaseKernel, Neighbours, Output, Particles, StepSize, Time};
use super::preset::{Defaults, defaults};
use super::reader::Reader;
use super::section::Section;
use crate::preset::Preset;

const NAME: &str = "letters, digits, - and _ (it names files)";
/// Places are within this of the origin \[m\].
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
    let (soil_section, water) = (root.section("soil"), root.section("water"));
    context.constituents(root);
    let soil = soil_section.is_given().then(|| context.soil(&soil_section, &gravity));
    let shared = soil.as_ref().filter(|_| water.is_given()).map(|soil| soil.volume_fraction);
    let particles = context.particles(&root.section("particles"), shared);
    let tank = context.tank(&root.section("tank"), &particles, soil.is_some(), shared.is_some());
    let water = water.is_given().then(|| context.water(&water, &gravity, tank.as_ref()));
    let mixing = root.section("mixture");
    let periodic = root.section("periodic");
    let case = Case {
        name: context.file_name(root, "name"),
        preset,
        dimension,
        precision: root.choice("precision").unwrap_or(Precision::F64),
        threads: root.count("threads", 0..=4096).unwrap_or(0) as usize,
        end_time,
        mixing: context.mixing(&mixing, &particles, soil.as_ref(), water.as_ref()),
        output: context.output(&root.section("output"), end_time, soil.is_some()),
        soil,
        water,
        gravity,
        particles,
        tank,
        outlets: root.sections("outlet").iter().map(|outlet| context.whole_region(outlet)).collect(),
        domain: context.domain(&root.section("domain")),
        periodic: periodic.choices("axes").unwrap_or_default(),
        time: context.time(&root.section("time")),
        neighbours: context.neighbours(&root.section("neighbours")),
        gauges: root.sections("gauge").iter().map(|gauge| context.gauge(gauge)).collect(),
    };
    periodic.finish();
    root.finish();
    case
}

impl Context<'_, '_> {
    /// There is soil, water or both.
    fn constituents(&self, root: &Section<'_, '_>) {
        let given = |key| self.reader.given(&root.name(key));
        if !given("soil") && !given("water") {
            let allowed = "[soil] with its blocks, or [water] with its blocks".to_owned();
            self.reader.missing("", "soil", allowed.clone());
            self.reader.missing("", "water", allowed);
        }
    }

    fn file_name(&self, section: &Section<'_, '_>, key: &'static str) -> String {
        let name = section.required_text(key, NAME);
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if name.is_empty() || name.len() > 100 || !name.chars().all(fits) {
            self.reader.error(&section.name(key), "cannot name a file", NAME);
        }
        name
    }

    /// `shared` is the volume fraction of soil that shares its space with water.
    fn particles(&self, section: &Section<'_, '_>, shared: Option<f64>) -> Particles {
        let ratio =
            |key| section.number(key, from_to(1.0, 4.0, "h/Δx; below 1 there are too few neighbours"));
        let smoothing_ratio = ratio("smoothing_ratio").unwrap_or_else(|| self.smoothing_ratio(shared));
        let kernel = section.choice("kernel").unwrap_or(self.defaults.kernel);
        let interphase = InterphaseKernel {
            smoothing_ratio: ratio("interphase_smoothing_ratio").unwrap_or(smoothing_ratio),
            kernel: section.choice("interphase_kernel").unwrap_or(kernel),
        };
        for key in ["interphase_smoothing_ratio", "interphase_kernel"] {
            if shared.is_none() && self.reader.given(&section.name(key)) {
                let why = "has nothing to couple";
                self.reader.error(&section.name(key), why, "[soil] and [water], or leave it out");
            }
        }
        let particles = Particles {
            spacing: section.required_number("spacing_m", positive(1e4, "m")),
            smoothing_ratio,
            kernel,
            gradient_correction: section.flag("gradient_correction").unwrap_or(false),
            interphase: shared.map(|_| interphase),
        };
        section.finish();
        particles
    }

    /// In soil, water is farther apart: a ratio is told by its spacing there.
    fn smoothing_ratio(&self, shared: Option<f64>) -> f64 {
        match shared.filter(|fraction| *fraction < 1.0 && self.defaults.preset == Preset::Default) {
            Some(fraction) => (1.5 / (1.0 - fraction).powf(1.0 / self.dimension as f64)).min(4.0),
            None => self.defaults.smoothing_ratio,
        }
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

    fn output(&self, section: &Section<'_, '_>, end_time: f64, has_soil: bool) -> Output {
        let every = section.number("dump_interval_s", positive(1e9, "s"));
        let at = section.numbers("dump_times_s", None, from_to(0.0, 1e9, "s"));
        if every.is_some() && at.is_some() {
            let name = section.name("dump_times_s");
            self.reader.error(&name, "contradicts dump_interval_s", "either dump_interval_s or dump_times_s");
        }
        let own = if has_soil { Field::EquivalentPlasticStrain } else { Field::Density };
        let standard = || vec![Field::Velocity, Field::Pressure, own];
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
