//! A vertical cut in cohesive soil: below its critical height it stands, above it falls.

use super::bars::Bars;
use super::head;
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::{Panel, ParticlePicture};
use crate::run::run_case;
use crate::screen;
use alluvium::case::{Case, Warnings};
use alluvium::verify::sand_column::{Pile, Section};
use std::path::{Path, PathBuf};

/// Height and width of the soil \[m\].
const HEIGHT: f64 = 1.0;
const WIDTH: f64 = 2.0;
const DENSITY: f64 = 2000.0;
const GRAVITY: f64 = 9.81;
const FRICTION_ANGLE: f64 = 20.0;
const SPACING: f64 = 0.025;
/// Several times √(H/g): what stands then does not move any more.
const DUMPS: &str = "0.0, 0.5, 1.5";
/// Heights over the critical one.
const RATIOS: [f64; 2] = [0.85, 1.15];
/// Parts of the height by which the crest may sink where the cut stands, and must where it falls.
const STANDS: f64 = 0.02;
const FALLS: f64 = 0.1;

/// Runs both, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let path = options.output.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&options.name));
    let mut folder = RunFolder::create(&path, options.output.existing)?;
    let case = case(RATIOS[0], spacing, options)?.0;
    let mut manifest = Manifest::new(&case, options.output.threads.map_or(case.threads, usize::from));
    manifest.write(&mut folder)?;
    let (mut bars, mut panels, mut steps) = (Bars::default(), Vec::new(), 0);
    for ratio in RATIOS {
        let cut = run(ratio, spacing, options, &path)?;
        let sunk = cut.sunk();
        let (bar, met) = if ratio < 1.0 {
            (format!("at most {STANDS}: it stands"), sunk <= STANDS)
        } else {
            (format!("at least {FALLS}: it falls"), sunk >= FALLS)
        };
        let what = format!("the crest has sunk, over the height, at {ratio} of the critical height");
        bars.add(&what, format!("{sunk:.3}"), bar, Some(met));
        panels.push(cut.panel(ratio));
        steps += cut.steps;
    }
    let picture = ParticlePicture {
        quantity: "equivalent plastic strain [-]",
        range: (0.001, 1.0),
        window: ([0.0, 0.0], [2.0 * WIDTH, 1.1 * HEIGHT]),
        spacing,
        axes: ["x [m]", "y [m]"],
        columns: 1,
    };
    folder.write("pictures/cuts.svg", &picture.svg_logarithmic(&panels))?;
    let report = format!(
        "# Vertical cut\n\nCohesive soil {HEIGHT} m high, θ = {FRICTION_ANGLE}°, ψ = 0, Δx = {spacing} m, at \
         1.5 s. The critical height is 3.83 c/(ρg) tan(45° + θ/2) (slip circle: Taylor 1937, Chen 1975; a \
         plane slip gives 4).\n\n{}",
        bars.markdown()
    );
    folder.write("report.md", &report)?;
    screen::print(report)?;
    screen::print(format_args!("picture in {}", folder.path().join("pictures").display()))?;
    manifest.end("done".to_owned(), steps);
    manifest.write(&mut folder)
}

/// A cut before and after.
struct Cut {
    start: Pile,
    end: Pile,
    steps: u64,
}

impl Cut {
    /// How far the grain at the crest has sunk, over the height.
    fn sunk(&self) -> f64 {
        let beyond = |place: [f64; 2]| (place[0] - WIDTH).hypot(place[1] - HEIGHT);
        let grains = self.start.grains().iter();
        let crest = grains.min_by(|a, b| beyond(a.place).total_cmp(&beyond(b.place)));
        let fallen = crest.and_then(|crest| Some(crest.place[1] - self.end.grain(crest.id)?.place[1]));
        fallen.unwrap_or(f64::NAN) / HEIGHT
    }

    fn panel(&self, ratio: f64) -> Panel {
        let grains = self.end.grains().iter().map(|grain| (grain.place, grain.plastic_strain)).collect();
        let caption = format!("{ratio} of the critical height");
        Panel { caption, layers: vec![grains], walls: Vec::new(), lines: Vec::new() }
    }
}

/// One cut, in a folder of its own.
fn run(ratio: f64, spacing: f64, options: &ReproduceOptions, path: &Path) -> Result<Cut, Failure> {
    let (case, warnings) = case(ratio, spacing, options)?;
    let out = Some(path.join(format!("height_{ratio}").replace('.', "_")));
    let output = OutputOptions { out, ..options.output.clone() };
    let mut piles = Vec::new();
    let finished =
        run_case(case, &warnings, &output, &mut |_, solver| piles.push(solver.pile(Section::FLAT)))?;
    let end = piles.pop();
    let start = piles.into_iter().next();
    let (Some(start), Some(end)) = (start, end) else {
        return Err(Failure::Numerical("nothing was measured".to_owned()));
    };
    Ok(Cut { start, end, steps: finished.steps })
}

/// The height stays, the cohesion does not.
fn case(ratio: f64, spacing: f64, options: &ReproduceOptions) -> Result<(Case, Warnings), Failure> {
    let slope = (45.0 + 0.5 * FRICTION_ANGLE).to_radians().tan();
    let cohesion = DENSITY * GRAVITY * HEIGHT / (3.83 * slope * ratio);
    let dilatancy = head::dilatancy(options.preset, FRICTION_ANGLE);
    let text = head::of_case(&options.name, options, DUMPS)
        + &format!(
            "[soil]\nreference_density_kg_per_m3 = {DENSITY:?}\nyoungs_modulus_pa = 2.0e6\n\
             poissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
             dilatancy_angle_deg = {dilatancy:?}\ncohesion_pa = {cohesion:?}\n\
             [soil.artificial_stress]\nstrength = 0.3\n\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{WIDTH:?}, {HEIGHT:?}]\n\
             [particles]\nspacing_m = {spacing:?}\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{:?}, {:?}]\nopen = [\"+y\"]\n\
             [output]\ndump_times_s = [{DUMPS}]\nfields = [\"velocity\", \"equivalent_plastic_strain\"]\n",
            2.0 * WIDTH,
            1.5 * HEIGHT
        );
    Ok(Case::parse(&options.name, &text)?)
}
