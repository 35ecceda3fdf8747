//! What can be said of a case's steps before it is run: every limit, and how drag goes through a step.

use super::choice::{KernelChoice, SchemeChoice};
use super::model::{Case, StepSize};
use crate::error::ParameterError;
use crate::kernel::{CubicSpline, QuinticSpline, WendlandC2, WendlandC4, WendlandC6, second_moment};
use crate::mixture::{CouplingForm, DragScheme, LEAST_PORES, RECONSTRUCTED_HASTE};

/// An estimate of the step one limit allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimit {
    /// What limits the step.
    pub name: &'static str,
    /// The step it allows \[s\].
    pub step: f64,
    /// Whether a run keeps to it; else it is there to be known.
    pub binds: bool,
}

/// How drag will go through a step, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct DragPlan {
    /// How.
    pub scheme: DragScheme,
    /// Why.
    pub why: String,
    /// The time t_s \[s\] in which drag stops a slip, in full soil.
    pub stopping_time: f64,
    /// The step without drag \[s\].
    pub step: f64,
    /// The viscosity m₂ h² C_d/(ρ_s + ρ_f) \[m²/s\] that drag between particles a smoothing length apart adds to
    /// motion soil and water share, unless velocities are reconstructed.
    pub spurious_viscosity: f64,
    /// Whether velocities are reconstructed between the particles of a pair, which takes that viscosity away and makes
    /// the limit of explicit drag a tenth shorter.
    pub is_reconstructed: bool,
    /// The law, with its parameters.
    pub law: String,
}

/// Beyond this Δt/t_s automatic drag is solved over the step: explicit drag then takes four steps of ½ t_s and more,
/// and a step of implicit drag costs about as much as four (`docs/performance.md`).
const STIFF: f64 = 2.0;

impl Case {
    /// What each limit allows, of the state at the start; the shortest that binds is the run's step, unless that is
    /// fixed. A force limit is that of gravity alone: a splash is accelerated more.
    pub fn step_limits(&self) -> Vec<StepLimit> {
        let mut limits = self.limits_without_drag();
        if let Some(plan) = self.drag_plan().filter(|plan| plan.stopping_time.is_finite()) {
            let binds = plan.scheme == DragScheme::Explicit;
            let haste = if plan.is_reconstructed { RECONSTRUCTED_HASTE } else { 1.0 };
            limits.push(StepLimit { name: "drag", step: 0.5 * plan.stopping_time / haste, binds });
        }
        limits
    }

    fn limits_without_drag(&self) -> Vec<StepLimit> {
        let h = self.smoothing_length();
        let courant = if let StepSize::Courant(courant) = self.time.step { courant } else { 0.2 };
        let gravity = self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let limit = |name, step, binds| StepLimit { name, step, binds };
        let mut limits = Vec::new();
        if let Some(soil) = &self.soil {
            limits.push(limit("acoustic (soil)", courant * h / soil.fastest_wave(), true));
        }
        if let Some(water) = &self.water {
            limits.push(limit("acoustic (water)", courant * h / water.sound_speed, true));
        }
        if let Some(step) = self.pore_limit() {
            limits.push(limit("acoustic (water in pores)", 0.5 * step, true));
        }
        if let Some(wave) = self.coupled_wave() {
            limits.push(limit("acoustic (soil and water as one)", courant * h / wave, false));
        }
        if let Some(water) = self.water.as_ref().filter(|water| water.viscosity > 0.0) {
            let step = 0.125 * h * h * water.reference_density / water.viscosity;
            limits.push(limit("viscous", step, true));
        }
        if gravity > 0.0 {
            limits.push(limit("force", 0.25 * (h / gravity).sqrt(), true));
        }
        limits
    }

    /// h φ_f/c \[s\], beyond which nothing holds; where pressure acts by differences.
    pub(super) fn pore_limit(&self) -> Option<f64> {
        let (soil, water) = (self.soil.as_ref()?, self.water.as_ref()?);
        let acts = self.mixing.as_ref()?.coupling == CouplingForm::PressureDifference;
        let pores = (1.0 - soil.volume_fraction).max(LEAST_PORES);
        let h = self.smoothing_length().min(self.interphase_smoothing_length());
        acts.then(|| h * pores / water.sound_speed)
    }

    /// Speed \[m/s\] of the fastest wave in soil full of water without drag: the larger root of
    /// |S − c² diag(ρ_s, ρ_f)| = 0 with the moduli of the mixture,
    /// S = [[φ_s M + K φ_s²/φ_f, K φ_s], [K φ_s, K φ_f]].
    fn coupled_wave(&self) -> Option<f64> {
        let (soil, water) = (self.soil.as_ref()?, self.water.as_ref()?);
        let (grains, pores) = (soil.volume_fraction, 1.0 - soil.volume_fraction);
        if pores <= 0.0 {
            return None;
        }
        let skeleton = soil.fastest_wave().powi(2) * soil.reference_density;
        let bulk = water.sound_speed.powi(2) * water.reference_density;
        let (rho_s, rho_f) = (grains * soil.reference_density, pores * water.reference_density);
        let a = (grains * skeleton + bulk * grains * grains / pores) / rho_s;
        let b = bulk * pores / rho_f;
        let cross = (bulk * grains).powi(2) / (rho_s * rho_f);
        let root = ((0.5 * (a - b)).powi(2) + cross).sqrt();
        Some((0.5 * (a + b) + root).sqrt())
    }

    /// How drag will go through a step; none without soil and water.
    pub fn drag_plan(&self) -> Option<DragPlan> {
        let (soil, water) = (self.soil.as_ref()?, self.water.as_ref()?);
        let mixing = self.mixing.as_ref()?;
        let law = mixing.drag.law::<f64>(water).ok()?;
        let fraction = (1.0 - soil.volume_fraction).max(0.0);
        let slip = self.fastest_slip();
        let density = water.reference_density;
        let coefficient = law.coefficient(fraction, density, slip);
        let (rho_s, rho_f) = (soil.volume_fraction * soil.reference_density, fraction * density);
        let stopping_time = 1.0 / (law.tangent(fraction, density, slip) * (1.0 / rho_s + 1.0 / rho_f));
        let bound = self.limits_without_drag().into_iter().filter(|limit| limit.binds);
        let step = match self.time.step {
            StepSize::Fixed(step) => step,
            StepSize::Courant(_) => bound.map(|limit| limit.step).fold(f64::INFINITY, f64::min),
        };
        let h = self.interphase_smoothing_length();
        let moment = self.second_moment().unwrap_or(0.0);
        let stiffness = step / stopping_time;
        let (scheme, why) =
            choose(mixing.drag_scheme, stiffness, matches!(self.time.step, StepSize::Fixed(_)));
        Some(DragPlan {
            scheme,
            why,
            stopping_time,
            step,
            spurious_viscosity: moment * h * h * coefficient / (rho_s + rho_f),
            is_reconstructed: mixing.reconstructed_drag,
            law: law.describe(),
        })
    }

    /// The fastest speed any water or inflow starts with \[m/s\].
    fn fastest_slip(&self) -> f64 {
        let speed = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let water = self.water.iter();
        let blocks = water.clone().flat_map(|water| &water.blocks).map(|block| speed(&block.velocity));
        let inflows = water.flat_map(|water| &water.inflows).map(|inflow| speed(&inflow.velocity));
        blocks.chain(inflows).fold(0.0, f64::max)
    }

    /// m₂ of the kernel between soil and water.
    fn second_moment(&self) -> Result<f64, ParameterError> {
        let kernel = self.particles.interphase.map_or(self.particles.kernel, |it| it.kernel);
        if self.dimension == 2 { moment::<2>(kernel) } else { moment::<3>(kernel) }
    }
}

fn moment<const D: usize>(kernel: KernelChoice) -> Result<f64, ParameterError> {
    Ok(match kernel {
        KernelChoice::WendlandC2 => second_moment::<f64, D>(&WendlandC2::new(1.0)?),
        KernelChoice::WendlandC4 => second_moment::<f64, D>(&WendlandC4::new(1.0)?),
        KernelChoice::WendlandC6 => second_moment::<f64, D>(&WendlandC6::new(1.0)?),
        KernelChoice::CubicSpline => second_moment::<f64, D>(&CubicSpline::new(1.0)?),
        KernelChoice::QuinticSpline => second_moment::<f64, D>(&QuinticSpline::new(1.0)?),
    })
}

fn choose(asked: SchemeChoice, stiffness: f64, is_fixed: bool) -> (DragScheme, String) {
    let given = |scheme| (scheme, "as the case says".to_owned());
    // A fixed step is not shortened.
    let bearable = if is_fixed { 0.5 } else { STIFF };
    match asked {
        SchemeChoice::Explicit => given(DragScheme::Explicit),
        SchemeChoice::BackwardEuler => given(DragScheme::BackwardEuler),
        SchemeChoice::SecondOrder => given(DragScheme::SecondOrder),
        SchemeChoice::Automatic if stiffness <= bearable => {
            (DragScheme::Explicit, format!("automatic: Δt/t_s is not above {bearable}"))
        }
        SchemeChoice::Automatic if cfg!(feature = "implicit") => {
            (DragScheme::BackwardEuler, format!("automatic: Δt/t_s is above {bearable}"))
        }
        SchemeChoice::Automatic => {
            (DragScheme::Explicit, "automatic: this build has no implicit drag".to_owned())
        }
    }
}
