//! A law of drag of one's own: a mat of fibres, `C_d = φ_f² ρ̃_f (A + B s)`.

use alluvium::material::DragLaw;

#[derive(Clone, Debug)]
pub struct Mat {
    /// A \[1/s\].
    pub viscous: f64,
    /// B \[1/m\].
    pub inertial: f64,
}

impl DragLaw<f64> for Mat {
    fn coefficient(&self, fraction: f64, true_density: f64, slip: f64) -> f64 {
        fraction * fraction * true_density * (self.viscous + self.inertial * slip)
    }
}
