//! Why a step could not be done: who, what, where and when.

use core::fmt;

/// The particle something is wrong with.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    /// `"soil"`, `"soil wall"`, `"water"` or `"water wall"`.
    pub kind: &'static str,
    /// Its id.
    pub particle: u32,
    /// Where it is \[m\].
    pub position: Vec<f64>,
    /// Time \[s\].
    pub time: f64,
}

impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} particle {} at {:?} m, t = {:.6e} s",
            self.kind, self.particle, self.position, self.time
        )
    }
}

/// Why a step could not be done.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError {
    /// A number is infinite or NaN.
    NotFinite {
        /// Whose.
        culprit: Culprit,
        /// Which field or rate.
        field: &'static str,
        /// The term of the equations it came from.
        term: &'static str,
    },
    /// A value no sound computation has.
    Absurd {
        /// Whose.
        culprit: Culprit,
        /// Which field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// Two particles at the same place.
    Overlap {
        /// One of them.
        culprit: Culprit,
        /// The other's id.
        other: u32,
        /// How far apart \[m\].
        distance: f64,
        /// How far apart they have to be at least \[m\].
        allowed: f64,
    },
    /// A particle has left the domain, and not through an outlet.
    Escaped {
        /// Which.
        culprit: Culprit,
        /// Lowest and highest corner of the domain \[m\].
        domain: [Vec<f64>; 2],
    },
    /// A fixed step that no Courant number allows.
    StepTooLong {
        /// The step \[s\].
        step: f64,
        /// The longest allowed \[s\].
        allowed: f64,
        /// What limits it.
        limit: crate::time::Limit,
        /// Time \[s\].
        time: f64,
    },
    /// A fixed step beyond what explicit drag bears.
    DragTooStiff {
        /// The step \[s\].
        step: f64,
        /// The longest allowed \[s\].
        allowed: f64,
        /// The law of drag, with its parameters.
        law: String,
        /// Time \[s\].
        time: f64,
    },
    /// Drag was to be reconstructed between particles and to act along the line between them.
    ProjectedDragReconstructed,
    /// The iteration for the slips that implicit drag depends on did not converge.
    DragUnsettled {
        /// Largest change of the slips in the last sweep \[m/s\].
        change: f64,
        /// The largest allowed \[m/s\].
        allowed: f64,
        /// How many sweeps were done.
        sweeps: usize,
        /// The law of drag, with its parameters.
        law: String,
        /// Time \[s\].
        time: f64,
    },
    /// The iteration for implicit drag did not converge.
    DragUnsolved {
        /// The residual it ended with.
        residual: f64,
        /// The largest allowed.
        allowed: f64,
        /// How many iterations were done.
        iterations: usize,
        /// Time \[s\].
        time: f64,
    },
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { culprit, field, term } => {
                write!(f, "{field} of {culprit} is not finite (term: {term})")
            }
            Self::Absurd { culprit, field, value, allowed } => {
                write!(f, "{field} of {culprit} is {value:.6e}: allowed is {allowed}")
            }
            Self::Overlap { culprit, other, distance, allowed } => write!(
                f,
                "{culprit} overlaps particle {other}: they are {distance:.3e} m apart, at least {allowed:.3e} m is allowed"
            ),
            Self::Escaped { culprit, domain: [low, high] } => {
                write!(f, "{culprit} has left the domain from {low:?} to {high:?} m, and through no outlet")
            }
            Self::StepTooLong { step, allowed, limit, time } => write!(
                f,
                "time step {step:.3e} s at t = {time:.6e} s is too long: the {limit} limit allows at most {allowed:.3e} s"
            ),
            Self::DragTooStiff { step, allowed, law, time } => write!(
                f,
                "time step {step:.3e} s at t = {time:.6e} s is too long for explicit drag by {law}: it allows at most {allowed:.3e} s; implicit drag (feature `implicit`) allows any"
            ),
            Self::ProjectedDragReconstructed => f.write_str(
                "reconstructed drag cannot be projected: take with_reconstructed_drag or with_projected_drag, not both",
            ),
            Self::DragUnsettled { change, allowed, sweeps, law, time } => write!(
                f,
                "implicit drag at t = {time:.6e} s by {law} is not settled after {sweeps} sweeps: slips still change by {change:.3e} m/s, allowed is {allowed:.3e} m/s"
            ),
            Self::DragUnsolved { residual, allowed, iterations, time } => write!(
                f,
                "implicit drag at t = {time:.6e} s is not solved after {iterations} iterations: the residual is {residual:.3e}, allowed is {allowed:.3e}"
            ),
        }
    }
}

impl core::error::Error for StepError {}
