//! What the studies share: a cloud on an arrangement, and the mistakes mutants make.

use alluvium::kernel::Kernel;
use alluvium::neighbours::{CellList, NeighbourSearch};
use alluvium::summation::{Cloud, Neighbourhood};
use alluvium::verify::Arrangement;
use alluvium::{Num, Real, Vector};
use std::ops::Range;

/// A cloud of density one on an arrangement, sorted as the library wants it.
pub struct Bench<T: Real, K, const D: usize> {
    pub x: Vec<Vector<T, D>>,
    pub masses: Vec<T>,
    pub densities: Vec<T>,
    pub neighbourhood: Neighbourhood<T, D>,
    pub kernel: K,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> Bench<T, K, D> {
    /// With the default search; repeating itself or with surfaces.
    pub fn new(arrangement: &Arrangement<D>, kernel: K, repeats: bool) -> Self {
        Self::with_search(arrangement, kernel, repeats, Box::<CellList<T, D>>::default())
    }

    pub fn with_search(
        arrangement: &Arrangement<D>,
        kernel: K,
        repeats: bool,
        search: Box<dyn NeighbourSearch<T, D>>,
    ) -> Self {
        let mut neighbourhood = Neighbourhood::new(search, kernel.support()).with_skin(T::ZERO);
        if repeats {
            let periodic = arrangement.periodic().expect("a box with an extent");
            neighbourhood = neighbourhood.with_periodic(periodic);
        }
        Self::with_neighbourhood(arrangement, kernel, neighbourhood)
    }

    pub fn with_neighbourhood(
        arrangement: &Arrangement<D>,
        kernel: K,
        mut neighbourhood: Neighbourhood<T, D>,
    ) -> Self {
        let places = arrangement.positions();
        let order = neighbourhood.cell_order(&places, 0);
        let x: Vec<_> = order.iter().map(|&i| neighbourhood.periodic().wrap(places[i as usize])).collect();
        neighbourhood.rebuild(&x, 0);
        let masses = vec![T::of(arrangement.volume); x.len()];
        let densities = vec![T::ONE; x.len()];
        Self { x, masses, densities, neighbourhood, kernel }
    }

    pub fn cloud(&self) -> Cloud<'_, T, K, D> {
        Cloud::new(&self.neighbourhood, &self.kernel, &self.x, &self.masses, &self.densities)
            .expect("a cloud as it was built")
    }

    /// A field at the particles, rounded to the precision.
    pub fn field(&self, f: impl Fn([f64; D]) -> f64) -> Vec<T> {
        self.x.iter().map(|x| T::of(f(x.as_f64()))).collect()
    }
}

/// A kernel with a mistake: wrong constants, or the support of another smoothing length.
#[derive(Clone, Debug)]
pub struct Flawed<K> {
    pub kernel: K,
    pub value_factor: f64,
    pub slope_factor: f64,
    pub stretch: f64,
}

impl<K> Flawed<K> {
    /// No mistake yet.
    pub fn none(kernel: K) -> Self {
        Self { kernel, value_factor: 1.0, slope_factor: 1.0, stretch: 1.0 }
    }
    /// Both constants wrong by a factor.
    pub fn scaled(kernel: K, factor: f64) -> Self {
        Self { value_factor: factor, slope_factor: factor, ..Self::none(kernel) }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> Kernel<T, D> for Flawed<K> {
    fn smoothing_length(&self) -> T {
        self.kernel.smoothing_length()
    }
    fn support(&self) -> T {
        self.kernel.support()
    }
    #[inline(always)]
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
        N::lit(self.value_factor) * self.kernel.value(r2 * N::lit(self.stretch * self.stretch))
    }
    #[inline(always)]
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
        N::lit(self.slope_factor) * self.kernel.slope(r2 * N::lit(self.stretch * self.stretch))
    }
}

/// A search that sees less far than it is told.
#[derive(Debug)]
pub struct ShortSighted<T, const D: usize> {
    points: Vec<Vector<T, D>>,
    radius: T,
    factor: f64,
}

impl<T: Real, const D: usize> ShortSighted<T, D> {
    pub fn new(factor: f64) -> Self {
        Self { points: Vec::new(), radius: T::ZERO, factor }
    }
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for ShortSighted<T, D> {
    fn name(&self) -> &'static str {
        "short-sighted"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.points = points.to_vec();
        self.radius = radius * T::of(self.factor);
    }
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        for (j, x) in self.points.iter().enumerate() {
            if (*x - *place).norm2() <= self.radius * self.radius {
                ranges.push(j as u32..j as u32 + 1);
            }
        }
    }
}
