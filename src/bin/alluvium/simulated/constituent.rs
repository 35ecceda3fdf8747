//! What is seen of one constituent, whatever its law.

use crate::solver::Seen;
use alluvium::case::Field;
use alluvium::material::{Material, Memory};
use alluvium::mixture::{Phase, WallKind};
use alluvium::output::{Component, LengthError, Vtp};
use alluvium::{Real, SymTensor, Vector};

/// The particles that are not walls.
pub fn inner<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> core::ops::Range<usize> {
    phase.wall_particles()..phase.len()
}

/// The foremost particle along x and half its spacing \[m\].
pub fn front<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> f64 {
    let half = |i: usize| 0.5 * phase.volume(i).as_f64().powf(1.0 / D as f64);
    inner(phase).map(|i| phase.positions()[i][0].as_f64() + half(i)).fold(f64::NEG_INFINITY, f64::max)
}

/// The greatest speed \[m/s\].
pub fn fastest<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> f64 {
    inner(phase).map(|i| phase.velocities()[i].norm().as_f64()).fold(0.0, f64::max)
}

/// Mass of what moves \[kg\].
pub fn mass<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> f64 {
    inner(phase).map(|i| phase.masses()[i].as_f64()).sum()
}

/// A place in three dimensions \[m\]; in two, z is 0.
pub fn place<T: Real, const D: usize>(x: Vector<T, D>) -> [f64; 3] {
    let x = x.as_f64();
    core::array::from_fn(|k| if k < D { x[k] } else { 0.0 })
}

/// The particles as a picture needs them.
pub fn seen<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> Vec<Seen> {
    let strain = Column::of::<T, M>(Field::EquivalentPlasticStrain);
    let seen = |i: usize| Seen {
        place: place(phase.positions()[i]),
        pressure: phase.pressures()[i].as_f64(),
        speed: phase.velocities()[i].norm().as_f64(),
        equivalent_plastic_strain: strain.map_or(0.0, |column| column.numbers(phase, i)[0]),
    };
    inner(phase).map(seen).collect()
}

/// Where a field is among the numbers a law shows of its memory.
#[derive(Clone, Copy)]
struct Column {
    first: usize,
    components: usize,
}

impl Column {
    /// None, if the law does not show it.
    fn of<T: Real, M: Material<T>>(field: Field) -> Option<Self> {
        let shown = <M::Memory as Memory<T>>::SHOWN;
        let n = shown.iter().position(|(name, _)| *name == field.to_string())?;
        let first = shown[..n].iter().map(|(_, components)| components).sum();
        Some(Self { first, components: shown[n].1 })
    }

    fn numbers<T: Real, const D: usize, M: Material<T>>(&self, phase: &Phase<T, D, M>, i: usize) -> Vec<f64> {
        let mut all = Vec::new();
        phase.memory(i).show(&mut all);
        all[self.first..self.first + self.components].to_vec()
    }
}

/// The particles as a file, with the fields that were asked for and that there are.
pub fn file<T: Real + Component, const D: usize, M: Material<T>>(
    time: f64,
    phase: &Phase<T, D, M>,
    fields: &[Field],
) -> Result<Vtp, LengthError> {
    let each = 0..phase.len();
    let kind = |i| u8::from(i < phase.wall_particles());
    let start = Vtp::new(time, phase.positions())
        .scalar("id", phase.ids().iter().copied())?
        .scalar("kind", each.clone().map(kind))?;
    let add = |file: Vtp, field: &Field| {
        let name = field.to_string();
        match field {
            Field::Velocity => file.vector(&name, phase.velocities().iter().copied()),
            Field::Pressure => file.scalar(&name, phase.pressures().iter().copied()),
            Field::Density => file.scalar(&name, each.clone().map(|i| phase.true_density(i))),
            Field::Mass => file.scalar(&name, phase.masses().iter().copied()),
            Field::VolumeFraction => file.scalar(&name, each.clone().map(|i| phase.volume_fraction(i))),
            Field::PartialDensity => file.scalar(&name, each.clone().map(|i| phase.density(i))),
            Field::Stress | Field::PlasticStrain | Field::EquivalentPlasticStrain => {
                remembered(file, *field, phase)
            }
        }
    };
    fields.iter().try_fold(start, add)
}

/// Adds what the law remembers, if it does.
fn remembered<T: Real + Component, const D: usize, M: Material<T>>(
    file: Vtp,
    field: Field,
    phase: &Phase<T, D, M>,
) -> Result<Vtp, LengthError> {
    let Some(column) = Column::of::<T, M>(field) else { return Ok(file) };
    let name = field.to_string();
    if column.components == 1 {
        return file.scalar(&name, (0..phase.len()).map(|i| T::of(column.numbers(phase, i)[0])));
    }
    let tensor = |i: usize| {
        // The memory of extrapolated walls does not follow what they show the soil.
        let wall = phase.bodies().get(i).map(|body| phase.walls()[usize::from(*body)].kind());
        if field == Field::Stress && wall.is_some_and(|kind| kind != WallKind::Dynamic) {
            return phase.stress(i);
        }
        let numbers = column.numbers(phase, i);
        SymTensor(core::array::from_fn(|k| T::of(numbers[k])))
    };
    file.tensor(&name, (0..phase.len()).map(tensor))
}
