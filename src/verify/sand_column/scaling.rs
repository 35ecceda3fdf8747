//! How far columns of other shapes run.

/// Normalised run-out `(L∞ − L₀)/L₀` \[-\] of a column `width` L₀ \[m\] wide whose heap ends at `front`
/// L∞ \[m\].
pub fn run_out(front: f64, width: f64) -> f64 {
    (front - width) / width
}

/// Run-out of quasi-two-dimensional columns, `(L∞ − L₀)/L₀ = factor · a^exponent` with a = H₀/L₀.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalingLaw {
    /// Who found it.
    pub source: &'static str,
    /// On what, and where it was read.
    pub reliability: &'static str,
    /// Between these aspect ratios \[-\].
    pub range: (f64, f64),
    /// Its factor \[-\].
    pub factor: f64,
    /// Its exponent \[-\].
    pub exponent: f64,
}

impl ScalingLaw {
    /// The run-out at an aspect ratio; none outside of its range.
    pub fn at(&self, aspect_ratio: f64) -> Option<f64> {
        let within = aspect_ratio > 0.0 && (self.range.0..=self.range.1).contains(&aspect_ratio);
        within.then(|| self.factor * aspect_ratio.powf(self.exponent))
    }
}

const fn law(
    (source, reliability): (&'static str, &'static str),
    range: (f64, f64),
    factor: f64,
    exponent: f64,
) -> ScalingLaw {
    ScalingLaw { source, reliability, range, factor, exponent }
}

const LUBE: (&str, &str) = ("Lube et al. 2005", "sand, rice and sugar; as quoted by Lagrée et al. 2011");
const LAJEUNESSE: (&str, &str) = ("Lajeunesse et al. 2005", "glass beads; as quoted by Lagrée et al. 2011");
const LAGREE: (&str, &str) = ("Lagrée et al. 2011", "μ(I) continuum, computed; secondary quote");
const NGUYEN: (&str, &str) =
    ("Nguyen et al. 2015", "aluminium rods, truly two-dimensional; from the abstract");

/// The laws of run-out in `verification/data/column_collapse_scaling_laws.csv`. The rods of Nguyen et al. are
/// those closest to the experiment of Bui et al. 2008; beads and sand in a channel with walls run less far.
pub const RUN_OUT: [ScalingLaw; 8] = [
    law(LUBE, (0.0, 1.8), 1.2, 1.0),
    law(LUBE, (2.8, f64::INFINITY), 1.9, 0.6667),
    law(LAJEUNESSE, (0.0, 3.0), 1.8, 1.0),
    law(LAJEUNESSE, (3.0, f64::INFINITY), 2.3, 0.6667),
    law(LAGREE, (0.0, 7.0), 2.2, 1.0),
    law(LAGREE, (7.0, f64::INFINITY), 3.9, 0.7),
    law(NGUYEN, (0.65, 1.5), 3.25, 0.96),
    law(NGUYEN, (1.5, f64::INFINITY), 3.8, 0.73),
];
