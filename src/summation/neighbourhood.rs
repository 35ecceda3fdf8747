//! A cloud of particles, who is near whom in it, and the sums over them.

mod passes;
mod staleness;

use crate::lanes::InstructionSet;
use crate::neighbours::{Ghost, Grid, NeighbourSearch, Periodic, SlicedList, sorted_candidates};
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use core::ops::Range;

/// The neighbours of a cloud of particles within the support κh of a kernel.
///
/// The list reaches a skin further than the support, so it stays right until two particles may have
/// approached each other by the skin: [`is_stale`](Self::is_stale) tells when. The first particles of
/// the cloud may be walls: a wall particle does not list other walls.
///
/// Between two rebuilds positions may change, but not their number or order. Under periodicity the
/// positions have to be inside the box when the list is rebuilt ([`Periodic::wrap`]), and leave it
/// freely until the next rebuild.
#[derive(Debug)]
pub struct Neighbourhood<T: Real, const D: usize> {
    search: Box<dyn NeighbourSearch<T, D>>,
    support: T,
    skin: T,
    periodic: Periodic<T, D>,
    set: InstructionSet,
    /// Particles and ghosts where they were at the last rebuild.
    points: Vec<Vector<T, D>>,
    particles: usize,
    ghosts: Vec<Ghost<T, D>>,
    list: SlicedList<T, D>,
    /// Each coordinate of the dummy.
    far: T,
    rebuilds: u64,
    /// Whether the particles are others than those listed.
    forgotten: bool,
}

impl<T: Real, const D: usize> Neighbourhood<T, D> {
    /// Neighbours at `r < support` \[m\], with a skin of a tenth of it, nothing periodic, and the
    /// widest lanes of the machine.
    pub fn new(search: Box<dyn NeighbourSearch<T, D>>, support: T) -> Self {
        Self {
            search,
            support,
            skin: support * T::of(0.1),
            periodic: Periodic::none(),
            set: InstructionSet::detect(),
            points: Vec::new(),
            particles: 0,
            ghosts: Vec::new(),
            list: SlicedList::default(),
            far: T::ZERO,
            rebuilds: 0,
            forgotten: true,
        }
    }

    /// Forgets the list: particles have come or gone.
    pub(crate) fn forget(&mut self) {
        self.forgotten = true;
    }

    /// Lists neighbours up to another support \[m\].
    pub(crate) fn set_support(&mut self, support: T) {
        self.support = support;
        self.forget();
    }

    /// Lists neighbours `skin` \[m\] beyond the support. Wider is rebuilt less often, but has more
    /// pairs to look at; what is not positive and finite means no skin.
    pub fn with_skin(mut self, skin: T) -> Self {
        self.skin = if skin > T::ZERO && skin.is_finite() { skin } else { T::ZERO };
        self.forget(); // a list with another skin serves no more
        self
    }

    /// Lets space repeat itself.
    pub fn with_periodic(mut self, periodic: Periodic<T, D>) -> Self {
        self.periodic = periodic;
        self.forget();
        self
    }

    /// Uses these instructions; results do not depend on them.
    pub fn with_instruction_set(mut self, set: InstructionSet) -> Self {
        self.set = set;
        self
    }

    /// Whether the list no longer serves `positions`: their number is another, or they have moved
    /// so far against each other (or one is not a number) that a pair might be missing.
    pub fn is_stale(&self, positions: &[Vector<T, D>]) -> bool {
        if self.forgotten || positions.len() != self.particles {
            return true;
        }
        staleness::have_strayed(positions, &self.points, self.skin)
    }

    /// The order that sorts the walls (the first `walls` positions) and the others by cell; particles
    /// of a cell keep their order. Permute all particle arrays by it (`new[k] = old[order[k]]`), then
    /// [`rebuild`](Self::rebuild): sorted neighbours are near in memory too.
    pub fn cell_order(&self, positions: &[Vector<T, D>], walls: usize) -> Vec<u32> {
        let (points, _) = self.with_images(positions);
        let grid = self.grid(&points);
        let walls = walls.min(positions.len());
        let mut order = Vec::with_capacity(positions.len());
        grid.order(&points, 0..walls, &mut order);
        grid.order(&points, walls..positions.len(), &mut order);
        order
    }

    /// Lists all neighbours anew. Rows of walls (the first `walls` positions) name no walls.
    pub fn rebuild(&mut self, positions: &[Vector<T, D>], walls: usize) {
        self.rebuild_for(positions, walls, |_, everything| vec![everything]);
    }

    /// Lists neighbours across two clouds only: the first `first` positions list the others, and the
    /// others list the first.
    pub(crate) fn rebuild_across(&mut self, positions: &[Vector<T, D>], first: usize) {
        self.rebuild_for(positions, first, |firsts, _| firsts);
    }

    /// Lists neighbours anew; the first `walls` positions list the others, the others what `seen` makes of
    /// (all of the first, everything), ghosts included.
    fn rebuild_for(
        &mut self,
        positions: &[Vector<T, D>],
        walls: usize,
        seen: impl Fn(Vec<Range<u32>>, Range<u32>) -> Vec<Range<u32>>,
    ) {
        let count = positions.len();
        let walls = walls.min(count);
        (self.points, self.ghosts) = self.with_images(positions);
        let wall_ghosts = self.ghosts.partition_point(|ghost| (ghost.owner as usize) < walls);
        self.sort_ghosts(count, wall_ghosts);
        self.particles = count;
        self.rebuilds += 1;
        self.forgotten = false;
        self.far = far_away(&self.points, self.support);

        let reach = self.support + self.skin;
        self.search.rebuild(&self.points, reach);
        let all = self.points.len() as u32;
        let others = vec![walls as u32..count as u32, (count + wall_ghosts) as u32..all];
        let firsts = vec![0..walls as u32, count as u32..(count + wall_ghosts) as u32];
        let allowed = [others, seen(firsts, 0..all)];
        self.list.build(&*self.search, &self.points, count, reach, walls, &allowed, self.set);
    }

    /// The positions and their images behind them, ghosts by owner.
    fn with_images(&self, positions: &[Vector<T, D>]) -> (Vec<Vector<T, D>>, Vec<Ghost<T, D>>) {
        let ghosts = self.periodic.ghosts(positions, self.support + self.skin);
        let mut points = Vec::with_capacity(positions.len() + ghosts.len());
        points.extend_from_slice(positions);
        points.extend(ghosts.iter().map(|ghost| positions[ghost.owner as usize] + ghost.shift));
        (points, ghosts)
    }

    /// The cells of the default search, so that what is sorted here is sorted for it.
    fn grid(&self, points: &[Vector<T, D>]) -> Grid<T, D> {
        Grid::cover(points, self.support + self.skin)
    }

    /// Sorts the ghosts of walls, then those of the others, by cell.
    fn sort_ghosts(&mut self, count: usize, wall_ghosts: usize) {
        if self.ghosts.is_empty() {
            return;
        }
        let grid = self.grid(&self.points);
        let mut order = Vec::with_capacity(self.ghosts.len());
        grid.order(&self.points, count..count + wall_ghosts, &mut order);
        grid.order(&self.points, count + wall_ghosts..self.points.len(), &mut order);
        self.ghosts = order.iter().map(|&g| self.ghosts[g as usize - count]).collect();
        let sorted: Vec<_> = order.iter().map(|&g| self.points[g as usize]).collect();
        self.points[count..].copy_from_slice(&sorted);
    }

    /// Calls `visit(j, xᵢ − xⱼ, r²)` for the listed neighbours of particle `i` at `r < κh`, strictly
    /// (41); a periodic image comes under its owner's index. A wall does not see walls.
    ///
    /// # Panics
    /// There is no particle `i`, or the number of positions is not that of the last rebuild.
    pub fn for_each_neighbour(
        &self,
        positions: &[Vector<T, D>],
        i: usize,
        mut visit: impl FnMut(usize, Vector<T, D>, T),
    ) {
        assert!(positions.len() == self.particles && i < self.particles);
        for j in self.list.of(i) {
            self.visit(positions, positions[i], j, &mut visit);
        }
    }

    /// The owners of all that is listed for particle `i`, within the support or not: the same until the list is
    /// rebuilt.
    #[cfg(feature = "implicit")]
    pub(crate) fn listed(&self, i: usize) -> impl Iterator<Item = usize> {
        let owner = |j: usize| j.checked_sub(self.particles).map_or(j, |g| self.ghosts[g].owner as usize);
        self.list.of(i).map(owner)
    }

    /// Calls `visit(j, x − xⱼ, r²)` for all particles at `r < κh`, strictly, from any `place` x.
    ///
    /// # Panics
    /// The number of positions is not that of the last rebuild.
    pub fn for_each_near(
        &self,
        positions: &[Vector<T, D>],
        place: &Vector<T, D>,
        mut visit: impl FnMut(usize, Vector<T, D>, T),
    ) {
        assert_eq!(positions.len(), self.particles);
        let place = self.periodic.wrap(*place);
        // The list bears that all particles move on together, but the search is asked for a place.
        if !staleness::have_stayed(positions, &self.points, self.skin) {
            for (j, x) in positions.iter().enumerate() {
                let away = self.periodic.difference(place, *x);
                if away.norm2() < self.support * self.support {
                    visit(j, away, away.norm2());
                }
            }
            return;
        }
        let everything = 0..self.points.len() as u32;
        let (mut raw, mut ranges) = (Vec::new(), Vec::new());
        sorted_candidates(&*self.search, &place, std::slice::from_ref(&everything), &mut raw, &mut ranges);
        for j in ranges.into_iter().flatten() {
            self.visit(positions, place, j as usize, &mut visit);
        }
    }

    fn visit(
        &self,
        positions: &[Vector<T, D>],
        place: Vector<T, D>,
        j: usize,
        visit: &mut impl FnMut(usize, Vector<T, D>, T),
    ) {
        let (owner, other) = match j.checked_sub(self.particles) {
            None => (j, positions[j]),
            Some(g) => {
                let ghost = &self.ghosts[g];
                (ghost.owner as usize, positions[ghost.owner as usize] + ghost.shift)
            }
        };
        let offset = place - other;
        let r2 = offset.norm2();
        if r2 < self.support * self.support {
            visit(owner, offset, r2);
        }
    }

    /// Support κh \[m\].
    pub fn support(&self) -> T {
        self.support
    }
    /// How far beyond the support the list reaches \[m\].
    pub fn skin(&self) -> T {
        self.skin
    }
    /// The periodic directions.
    pub fn periodic(&self) -> &Periodic<T, D> {
        &self.periodic
    }
    /// The periodic images of the last rebuild: those of walls first, each by cell.
    pub fn ghosts(&self) -> &[Ghost<T, D>] {
        &self.ghosts
    }
    /// How many particles there were at the last rebuild.
    pub fn particles(&self) -> usize {
        self.particles
    }
    /// Where the particles were at the last rebuild \[m\]; empty if they are others now.
    pub fn reference_positions(&self) -> &[Vector<T, D>] {
        if self.forgotten { &[] } else { &self.points[..self.particles] }
    }
    /// How often the list has been rebuilt.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }
    /// The instructions the sums use.
    pub fn instruction_set(&self) -> InstructionSet {
        self.set
    }
    /// The name of the neighbour search.
    pub fn search_name(&self) -> &'static str {
        self.search.name()
    }
    /// Bytes held, but for those of the search.
    pub fn bytes(&self) -> usize {
        self.list.bytes()
            + self.points.capacity() * size_of::<Vector<T, D>>()
            + self.ghosts.capacity() * size_of::<Ghost<T, D>>()
    }
}

/// A coordinate at least a thousand supports beyond every point, whatever its rounding.
fn far_away<T: Real, const D: usize>(points: &[Vector<T, D>], support: T) -> T {
    let largest = parallel::reduce(
        points.len(),
        T::ZERO,
        |range| {
            let mut most = T::ZERO;
            for x in points[range].iter().flat_map(|x| x.0) {
                if x.abs() > most && x.is_finite() {
                    most = x.abs();
                }
            }
            most
        },
        |a, b| if a > b { a } else { b },
    );
    largest + largest + T::of(1000.0) * support
}

#[cfg(test)]
mod tests;
