//! Soil in a section, and its surface.

use crate::kernel::{Kernel, WendlandC2};
use crate::material::{Material, Memory};
use crate::mixture::Mixture;
use crate::real::Real;
use crate::space::SymTensor;
use crate::verify::Curve;
use std::collections::HashMap;

/// Which section of the soil is looked at; its floor is at y = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// Along x from a wall at x = 0: all there is in two dimensions, the mean over the width of a channel
    /// in three.
    Plane {
        /// Width of the channel \[m\]; 1 in two dimensions.
        width: f64,
    },
    /// Along the distance from a vertical axis, in three dimensions: the mean over a sector.
    Round {
        /// Where the axis is, x and z \[m\].
        axis: [f64; 2],
        /// Angle of the sector \[rad\]: 2π for all around.
        angle: f64,
    },
}

impl Section {
    /// All there is in two dimensions.
    pub const FLAT: Self = Self::Plane { width: 1.0 };

    fn place(&self, x: [f64; 3]) -> [f64; 2] {
        match self {
            Self::Plane { .. } => [x[0], x[1]],
            Self::Round { axis, .. } => [(x[0] - axis[0]).hypot(x[2] - axis[1]), x[1]],
        }
    }

    /// What one unit of the section's area stands for at a distance \[m\].
    fn depth(&self, distance: f64) -> f64 {
        match self {
            Self::Plane { width } => *width,
            Self::Round { angle, .. } => angle * distance,
        }
    }
}

/// One particle of soil in a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Its number, which stays.
    pub id: u32,
    /// Distance from wall or axis, and height \[m\].
    pub place: [f64; 2],
    /// Its volume \[m³, in 2D m²\].
    pub volume: f64,
    /// Its speed \[m/s\].
    pub speed: f64,
    /// Its pressure \[Pa\].
    pub pressure: f64,
    /// Its equivalent plastic strain \[-\]; zero if its law remembers none.
    pub plastic_strain: f64,
    /// Its plastic shear strain ε_p^xy \[-\] (79); zero if its law remembers none.
    pub plastic_shear: f64,
}

/// The soil of an instant in a section, walls left out.
///
/// The **surface** at x is the highest place where the soil fills half of what a kernel reaches,
/// `Σ V_j W = ½`, on the section with its images behind wall and floor. Half is what a level surface of
/// a lattice has half a spacing above its upper row, within a hundredth of a spacing at any resolution. The
/// highest particle, the other choice, is a spacing wrong where one grain lies on a slope, and takes grains
/// that lie about alone for a surface. The kernel is Wendland's C2 with 1.3 spacings whatever the run's, so
/// that runs compare. Grains with fewer than three others in its reach are loose, and not of the heap: their
/// density may say that each alone fills the half.
#[derive(Clone, Debug, PartialEq)]
pub struct Pile {
    section: Section,
    spacing: f64,
    grains: Vec<Grain>,
    kernel: WendlandC2<f64, 2>,
    /// Places and areas on the section, images included, by columns as wide as the kernel's support.
    columns: HashMap<i64, Vec<([f64; 2], f64)>>,
}

/// The kernel's smoothing length over the spacing.
const SMOOTHING: f64 = 1.3;

impl Pile {
    /// The soil of a mixture.
    pub fn of<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        mixture: &Mixture<T, D, K, S, F>,
        section: Section,
    ) -> Self {
        let soil = mixture.soil();
        let inner = soil.wall_particles()..soil.len();
        let edge = |i: usize| soil.volume(i).as_f64().powf(1.0 / D as f64);
        let spacing = inner.clone().map(edge).sum::<f64>() / inner.len().max(1) as f64;
        let [equivalent, tensor] = ["equivalent_plastic_strain", "plastic_strain"].map(shown_at::<T, S>);
        let shear = tensor.map(|first| first + SymTensor::<T>::index(0, 1));
        let mut memory = Vec::new();
        let grain = |i: usize| {
            memory.clear();
            soil.memory(i).show(&mut memory);
            let x = soil.positions()[i].as_f64();
            Grain {
                id: soil.ids()[i],
                place: section.place(core::array::from_fn(|k| if k < D { x[k] } else { 0.0 })),
                volume: soil.volume(i).as_f64(),
                speed: soil.velocities()[i].norm().as_f64(),
                pressure: soil.pressures()[i].as_f64(),
                plastic_strain: equivalent.map_or(0.0, |at| memory[at]),
                plastic_shear: shear.map_or(0.0, |at| memory[at]),
            }
        };
        Self::new(section, spacing, inner.map(grain).collect())
    }

    /// From particles a `spacing` \[m\] apart in the mean.
    ///
    /// # Panics
    /// The spacing is not positive although there are particles.
    pub fn new(section: Section, spacing: f64, mut grains: Vec<Grain>) -> Self {
        grains.sort_by_key(|grain| grain.id);
        let spacing = if grains.is_empty() { 1.0 } else { spacing };
        let kernel = WendlandC2::new(SMOOTHING * spacing).expect("a positive spacing");
        let mut pile = Self { section, spacing, grains, kernel, columns: HashMap::new() };
        let loose = loose(&pile.grains, kernel.support());
        for (grain, _) in pile.grains.iter().zip(loose).filter(|(_, loose)| !loose) {
            let [x, y] = grain.place;
            // On the axis itself a section has no depth.
            let area = grain.volume / section.depth(x.abs().max(0.25 * spacing));
            for image in [[x, y], [-x, y], [x, -y], [-x, -y]] {
                let column = column(image[0], kernel.support());
                pile.columns.entry(column).or_default().push((image, area));
            }
        }
        pile
    }

    /// Its particles, in ascending order of their numbers.
    pub fn grains(&self) -> &[Grain] {
        &self.grains
    }

    /// Mean distance of particles \[m\].
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Height of the surface \[m\] at a distance from wall or axis; 0 where there is no soil.
    pub fn surface(&self, x: f64) -> f64 {
        let reach = self.kernel.support();
        let middle = column(x, reach);
        let columns = (middle - 1..=middle + 1).filter_map(|at| self.columns.get(&at));
        let near: Vec<_> = columns.flatten().filter(|(at, _)| (at[0] - x).abs() < reach).collect();
        let filled = |y: f64| -> f64 {
            let part = |(at, area): &&([f64; 2], f64)| {
                area * self.kernel.value((at[0] - x).powi(2) + (at[1] - y).powi(2))
            };
            near.iter().map(part).sum()
        };
        let top = near.iter().map(|(at, _)| at[1]).fold(0.0, f64::max) + reach;
        let step = 0.1 * self.spacing;
        let steps = if near.is_empty() { 0 } else { (top / step) as usize };
        let below = (1..=steps).map(|n| top - n as f64 * step).find(|y| filled(*y) >= 0.5);
        below.map_or(0.0, |low| bisect(low, low + step, |y| filled(y) >= 0.5))
    }

    /// The surface from the wall, or the axis, to the farthest particle.
    pub fn profile(&self) -> Curve {
        let step = 0.5 * self.spacing;
        let count = if self.grains.is_empty() { 0 } else { (self.farthest() / step) as usize + 2 };
        Curve::new((0..count).map(|n| n as f64 * step).map(|x| (x, self.surface(x))).collect())
    }

    /// The largest distance \[m\] at which the surface is as high as this \[m\]; none if it never is.
    pub fn reach(&self, height: f64) -> Option<f64> {
        let step = 0.25 * self.spacing;
        let start = self.farthest() + self.kernel.support();
        let steps = (start / step) as usize;
        let inside = (1..=steps).map(|n| start - n as f64 * step).find(|x| self.surface(*x) >= height)?;
        Some(bisect(inside, inside + step, |x| self.surface(x) >= height))
    }

    /// Where the heap ends \[m\]: grains that lie about alone are not of it.
    pub fn front(&self) -> f64 {
        self.reach(0.5 * self.spacing).unwrap_or(0.0)
    }

    /// The farthest particle and half its spacing \[m\].
    pub fn farthest(&self) -> f64 {
        self.grains.iter().map(|grain| grain.place[0] + 0.5 * self.spacing).fold(0.0, f64::max)
    }

    /// Volume below the surface \[m³, in 2D m²\]: what a ruler would find.
    pub fn volume_below_surface(&self) -> f64 {
        let step = 0.25 * self.spacing;
        let steps = ((self.farthest() + self.kernel.support()) / step) as usize;
        let slice = |n: usize| {
            let x = (n as f64 + 0.5) * step;
            self.surface(x) * self.section.depth(x) * step
        };
        (0..steps).map(slice).sum()
    }

    /// Volume `Σ V` of the particles \[m³, in 2D m²\]: what the densities say.
    pub fn volume(&self) -> f64 {
        self.grains.iter().map(|grain| grain.volume).sum()
    }

    /// The largest pressure \[Pa\].
    pub fn largest_pressure(&self) -> f64 {
        self.grains.iter().map(|grain| grain.pressure).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Root mean square of the velocity \[m/s\].
    pub fn rms_velocity(&self) -> f64 {
        let sum: f64 = self.grains.iter().map(|grain| grain.speed * grain.speed).sum();
        (sum / self.grains.len().max(1) as f64).sqrt()
    }

    /// The particle of this number.
    pub fn grain(&self, id: u32) -> Option<&Grain> {
        self.grains.binary_search_by_key(&id, |grain| grain.id).ok().map(|at| &self.grains[at])
    }
}

/// Others in reach that make a grain one of the heap.
const COMPANY: usize = 3;

/// Which grains lie about alone.
fn loose(grains: &[Grain], reach: f64) -> Vec<bool> {
    let cell = |place: [f64; 2]| place.map(|x| column(x, reach));
    let mut cells: HashMap<[i64; 2], Vec<[f64; 2]>> = HashMap::new();
    for grain in grains {
        cells.entry(cell(grain.place)).or_default().push(grain.place);
    }
    let is_loose = |grain: &Grain| {
        let [i, j] = cell(grain.place);
        let around = (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| [i, j]));
        let places = around.filter_map(|at| cells.get(&at)).flatten();
        let near = |at: &&[f64; 2]| (at[0] - grain.place[0]).hypot(at[1] - grain.place[1]) < reach;
        // One more than the others: it finds itself.
        places.filter(near).take(COMPANY + 1).count() <= COMPANY
    };
    grains.iter().map(is_loose).collect()
}

/// Where among the numbers a law's memory shows a field begins.
fn shown_at<T: Real, S: Material<T>>(field: &str) -> Option<usize> {
    let shown = <S::Memory as Memory<T>>::SHOWN;
    let at = shown.iter().position(|(name, _)| *name == field)?;
    Some(shown[..at].iter().map(|(_, components)| components).sum())
}

fn column(x: f64, width: f64) -> i64 {
    (x / width).floor() as i64
}

/// Where between `inside` and `outside` something ends to hold.
fn bisect(mut inside: f64, mut outside: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..30 {
        let middle = 0.5 * (inside + outside);
        *(if holds(middle) { &mut inside } else { &mut outside }) = middle;
    }
    0.5 * (inside + outside)
}
