//! The paper's jet on saturated soil, and what is looked at.

use crate::bands::range;
use crate::shared_runs::SharedRuns;
use alluvium::budget::Account;
use alluvium::case::Case;
use alluvium::kernel::WendlandC2;
use alluvium::parallel::Threads;
use alluvium::verify::Parcel;
use alluvium::verify::jet::{Hole, overflow};
use alluvium::{Preset, Real};
use std::ops::ControlFlow;

const CASE: &str = include_str!("cases/jet.toml");
/// The paper's \[m\].
pub const SPACING: f64 = 0.005;
/// Instants that are looked at \[s\].
pub const TIMES: [f64; 3] = [0.002, 0.005, 0.01];

/// A jet, by default the paper's on soil that keeps its volume.
#[derive(Clone, Debug)]
pub struct Jet {
    pub spacing: f64,
    /// Hydraulic conductivity \[m/s\].
    pub conductivity: f64,
    /// Volume fraction of the soil \[-\].
    pub fraction: f64,
    /// Dilatancy angle ψ \[°\].
    pub dilatancy: f64,
    /// Of the jet \[m/s\].
    pub speed: f64,
    pub scheme: &'static str,
    pub reconstructed: bool,
    /// Smoothing length over the spacing h/Δx \[-\]; none is that of the preset.
    pub smoothing_ratio: Option<f64>,
    /// How the soil's stress is kept admissible.
    pub plasticity: &'static str,
    /// Whether water boils at −1 atm; otherwise it bears any suction.
    pub boils: bool,
}

impl Default for Jet {
    fn default() -> Self {
        Self {
            spacing: SPACING,
            conductivity: 5e-4,
            fraction: 0.5,
            dilatancy: 0.0,
            speed: 25.0,
            scheme: "automatic",
            reconstructed: false,
            smoothing_ratio: None,
            plasticity: "return-mapping",
            boils: true,
        }
    }
}

/// What was seen of a jet.
#[derive(Clone)]
pub struct Dig {
    pub hole: Hole,
    /// Matter \[m²\] above the rim and beyond it, of the soil.
    pub overflow: [f64; 2],
    pub fractions: [f64; 2],
    /// At each of [`TIMES`], and at any time \[Pa\].
    pub pressures: [[f64; 2]; 3],
    pub extremes: [f64; 2],
    /// Kinetic energy at the end over what the jet brought \[-\].
    pub kept: f64,
}

impl Jet {
    pub fn dig(&self) -> Dig {
        static RUNS: SharedRuns<Dig> = SharedRuns::new();
        RUNS.get(format!("{self:?}"), || self.run::<f64>())
    }

    pub fn depth(&self) -> f64 {
        self.dig().hole.depth()
    }

    /// With the default preset, and as many rows of water in the nozzle as the support needs.
    fn case(&self) -> Case {
        let Self { spacing, conductivity, fraction, dilatancy, speed, scheme, reconstructed, .. } = self;
        let ratio =
            self.smoothing_ratio.map(|ratio| format!("\nsmoothing_ratio = {ratio:?}")).unwrap_or_default();
        let cavitation = if self.boils { "cavitation_pressure_pa = -101325.0\n" } else { "" };
        let text = CASE
            .replace("PRESET", "default")
            .replace("INTEGRATOR", "leap-frog-ab3")
            .replace("spacing_m = 0.005", &format!("spacing_m = {spacing:?}{ratio}"))
            .replace("volume_fraction = 0.5", &format!("volume_fraction = {fraction:?}"))
            .replace("dilatancy_angle_deg = 0.0", &format!("dilatancy_angle_deg = {dilatancy:?}"))
            .replace("[[soil.block]]", &format!("plasticity = \"{}\"\n[[soil.block]]", self.plasticity))
            .replace("[[water.block]]", &format!("{cavitation}[[water.block]]"))
            .replace("conductivity_m_per_s = 5.0e-4", &format!("conductivity_m_per_s = {conductivity:?}"))
            .replace(
                "[mixture]",
                &format!("[mixture]\ndrag_scheme = \"{scheme}\"\nreconstructed_drag = {reconstructed}"),
            )
            .replace("[0.0, -25.0]", &format!("[0.0, {:?}]", -speed));
        Case::parse("jet", &text).expect("a case").0
    }

    pub fn run<T: Real>(&self) -> Dig {
        let case = self.case();
        let kernel = WendlandC2::<T, 2>::new(T::of(case.smoothing_length())).expect("a length");
        let mut run = case.simulation(kernel, Preset::Default.leap_frog()).expect("a case");
        // One thread each: the harness runs studies side by side.
        Threads::new(1).expect("a thread").install(|| {
            run.start().expect("a start");
            let start = run.budget();
            let (mut fractions, mut extremes) = (Vec::new(), Vec::new());
            let pressures = TIMES.map(|time| {
                let _: ControlFlow<()> = run
                    .run_until(time, |run| {
                        let water = run.mixture().water();
                        let inner = water.wall_particles()..water.len();
                        fractions.extend(range(inner.clone().map(|i| water.volume_fraction(i).as_f64())));
                        extremes.extend(range(inner.map(|i| water.pressures()[i].as_f64())));
                        ControlFlow::Continue(())
                    })
                    .expect("a sound run");
                range(Parcel::of(run.mixture().water()).iter().map(|it| it.pressure))
            });
            let end = run.budget();
            let came = start.taken[Account::Inflow] - end.taken[Account::Inflow];
            let soil = Parcel::of(run.mixture().soil());
            let hole = Hole::of(&soil, self.spacing, self.fraction);
            let [fractions, extremes] = [fractions, extremes].map(range);
            Dig { hole, overflow: overflow(&soil), fractions, pressures, extremes, kept: end.kinetic / came }
        })
    }
}
