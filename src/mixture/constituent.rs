//! A phase and what its own equations need: who is near whom, numerics, buffers.

use super::setting::Setting;
use super::source::SourceField;
use super::wall_contact::Contact;
use super::{
    ArtificialStress, ArtificialViscosity, DensityDiffusion, GradientWeight, HourglassControl, Phase,
    StepError,
};
use crate::budget::Exchange;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::neighbours::CellList;
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Aligned, Neighbourhood, Sums};
use crate::time::Limits;

/// Which of the two a constituent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Soil,
    Water,
}

/// One of the two constituents of a mixture.
pub(super) struct Constituent<T: Real, const D: usize, M: Material<T>> {
    pub(super) role: Role,
    pub(super) phase: Phase<T, D, M>,
    pub(super) neighbourhood: Neighbourhood<T, D>,
    pub(super) viscosity: ArtificialViscosity<T>,
    pub(super) diffusion: DensityDiffusion<T>,
    pub(super) gradient_weight: GradientWeight,
    pub(super) strain_control: T,
    pub(super) hourglass_control: Option<HourglassControl<T>>,
    /// Whether gradients are exact for linear fields.
    pub(super) is_corrected: bool,
    pub(super) artificial_stress: Option<ArtificialStress<T>>,
    /// What acts on it alone, from outside.
    pub(super) source: Option<SourceField<T, D, M::Memory>>,
    /// Whether the pressure of water acts on all of its space, of which the coupling takes the soil's part.
    pub(super) shares_pressure: bool,
    /// Density of the water that bears part of each soil particle's weight \[kg/m³\]; empty without water.
    pub(super) buoyancy: Vec<T>,
    /// Energy per time and force, at the last evaluation.
    pub(super) exchange_rate: Exchange<D>,
    pub(super) fastest_acceleration: T,
    pub(super) scratch: Scratch<T, D>,
}

/// Buffers that live from one evaluation to the next.
#[derive(Default)]
pub(super) struct Scratch<T: Real, const D: usize> {
    pub(super) records: Aligned<T>,
    pub(super) sums: Sums<T>,
    pub(super) extra: Sums<T>,
    /// The velocity viscosity sees at each wall particle \[m/s\]; empty where no wall extrapolates.
    pub(super) wall_velocity: Vec<Vector<T, D>>,
    /// What each wall particle offers soil that glides; empty where no wall extrapolates.
    pub(super) contacts: Vec<Contact<T, D>>,
    /// Of each wall particle, into the wall; empty where nothing may glide.
    pub(super) wall_normal: Vec<Vector<T, D>>,
    /// Whether each wall particle is near enough to the material to have a pressure; empty where no wall
    /// extrapolates.
    pub(super) reached: Vec<bool>,
    /// ∇v by rows \[1/s\]; empty without control of what it does not see.
    pub(super) velocity_gradient: Vec<[Vector<T, D>; D]>,
    /// B by rows \[-\]; empty unless gradients are corrected.
    pub(super) correction: Vec<[Vector<T, D>; D]>,
    /// ∇·v \[1/s\]; empty unless gradients are corrected.
    pub(super) expansion: Vec<T>,
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// With the default numerics of its role.
    pub(super) fn new(role: Role, phase: Phase<T, D, M>, support: T) -> Self {
        let (linear, diffusion) = match role {
            Role::Soil => (0.1, DensityDiffusion::None),
            Role::Water => (0.01, DensityDiffusion::Hydrostatic(T::of(0.1))),
        };
        Self {
            role,
            phase,
            neighbourhood: Neighbourhood::new(Box::new(CellList::default()), support),
            viscosity: ArtificialViscosity { linear: T::of(linear), quadratic: T::ONE },
            diffusion,
            gradient_weight: GradientWeight::default(),
            strain_control: T::ZERO,
            hourglass_control: None,
            is_corrected: false,
            artificial_stress: None,
            source: None,
            shares_pressure: false,
            buoyancy: Vec::new(),
            exchange_rate: Exchange::default(),
            fastest_acceleration: T::ZERO,
            scratch: Scratch::default(),
        }
    }

    /// The equations of one constituent alone.
    pub(super) fn evaluate<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> Result<(), StepError> {
        if self.phase.is_empty() {
            return Ok(());
        }
        self.settle(setting)?;
        self.find_state(setting);
        self.act_on_itself(setting);
        self.conclude(setting)
    }

    /// Checks what came, and who is near whom.
    pub(super) fn settle<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> Result<(), StepError> {
        let are_listed = !self.neighbourhood.is_stale(&self.phase.position);
        self.check_fields(setting, are_listed)?;
        self.prepare_hold();
        if !are_listed {
            self.list_neighbours();
        }
        Ok(())
    }

    /// Pressure, and what walls show.
    pub(super) fn find_state<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.find_pressure(); // (16), (20)
        self.extrapolate_walls(setting);
    }

    /// The forces and rates within the constituent.
    pub(super) fn act_on_itself<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.find_stress(setting); // (62), (14), (15); (65), (66), (33)
        self.sum_own_pairs(setting); // (52), (58); (53), (55)
        self.add_renormalised_diffusion(setting); // (52), second sum, in the form of Antuono et al.
        self.add_strain_control(setting);
        self.add_hourglass_control(setting);
        self.rub_contacts(setting); // (55)
        self.add_artificial_stress(setting);
    }

    /// What comes from outside, and a look at the result.
    pub(super) fn conclude<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> Result<(), StepError> {
        self.add_body_forces(setting);
        self.add_source(setting);
        self.check_rates(setting)
    }

    /// Volume \[m³, in 2D m²\] on which the pressure of particle `i` acts: none deep in a wall, where there is no
    /// pressure.
    #[inline(always)]
    pub(super) fn pressing_volume(&self, i: usize) -> T {
        if self.scratch.reached.get(i) == Some(&false) { T::ZERO } else { self.phase.volume(i) }
    }

    /// Limits of the time step \[s\], from the last evaluation.
    pub(super) fn limits(&self, h: T) -> Limits<T> {
        if self.phase.is_empty() {
            return Limits::none();
        }
        let nu = self.phase.material().kinematic_viscosity();
        let a = self.fastest_acceleration;
        let or_infinite = |positive: bool, limit: T| if positive { limit } else { T::INFINITY };
        Limits {
            acoustic: h / self.phase.material().fastest_wave(),
            viscous: or_infinite(nu > T::ZERO, T::of(0.125) * h * h / nu),
            force: or_infinite(a > T::ZERO, T::of(0.25) * (h / a).sqrt()),
            ..Limits::none()
        }
    }

    /// Bytes held in particle arrays, lists and buffers.
    pub(super) fn bytes(&self) -> usize {
        let scratch = &self.scratch;
        self.phase.bytes()
            + self.neighbourhood.bytes()
            + scratch.records.bytes()
            + scratch.sums.bytes()
            + scratch.extra.bytes()
    }
}
