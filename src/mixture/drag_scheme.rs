//! The ways drag may go through a time step.

/// How drag between soil and water goes through a time step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DragScheme {
    /// Evaluated like any force: it limits the step, the harder the lower the conductivity.
    #[default]
    Explicit,
    /// Backward Euler: of first order, damps a slip by 1/(1 + Δt/t_s) and never reverses it; the right
    /// terminal slip at any step.
    BackwardEuler,
    /// The two-stage method SDIRK2 with γ = 1 − 1/√2 (Alexander 1977): of second order where Δt < t_s,
    /// damps stiff slip as well, but may reverse a small part of it; two solves.
    SecondOrder,
}

impl DragScheme {
    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Explicit => "explicit",
            Self::BackwardEuler => "backward-euler",
            Self::SecondOrder => "second-order",
        }
    }
}

impl core::fmt::Display for DragScheme {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}
