//! What the studies share: a cloud on an arrangement, and numbers of ready-made studies.

use alluvium::kernel::Kernel;
use alluvium::neighbours::{CellList, NeighbourSearch};
use alluvium::summation::{Cloud, Neighbourhood};
use alluvium::verify::{Arrangement, Conditions, Measured, Study};
use alluvium::{Real, Vector};

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

/// What one of the ready-made studies measures, under the mutant in force too.
pub fn measured(studies: &[Study], what: &str, conditions: &Conditions) -> Measured {
    let is_it = |study: &&Study| study.name.rsplit_once('/').is_some_and(|(_, name)| name == what);
    let study = studies.iter().find(is_it).unwrap_or_else(|| panic!("there is a study of `{what}`"));
    let outcome = conditions.mutant.map_or_else(|| study.run(), |mutant| study.run_mutant(mutant));
    outcome.measured.unwrap_or_else(|| panic!("{}: {}", study.name, outcome.sentence))
}
