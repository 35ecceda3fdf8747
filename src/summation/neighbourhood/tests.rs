use super::*;
use crate::neighbours::{BruteForce, CellList};
use crate::real::Num;
use crate::summation::{Aligned, PairFormula, Sums};

/// Σ m_j (κh − r)₊ over the neighbours, and how many records were read at r < κh.
struct Cone<T> {
    support: T,
}

impl<T: Real> PairFormula<T> for Cone<T> {
    const BLOCKS: usize = 1;
    const SUMS: usize = 2;
    type At<N: Num<Scalar = T>> = [N; 4];
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> [N; 4] {
        record[0]
    }
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &[N; 4], j: &[N; 4], sums: &mut [N; crate::summation::MOST]) {
        let (x, y) = (i[0] - j[0], i[1] - j[1]);
        let t = (N::splat(self.support) - (x * x + y * y).sqrt()).max(N::lit(0.0));
        sums[0] += j[2] * t;
        sums[1] += j[3];
    }
}

/// A jittered cloud in the unit square.
fn cloud(side: usize) -> Vec<Vector<f64, 2>> {
    let step = 1.0 / side as f64;
    (0..side * side)
        .map(|k| {
            let wobble = |s: f64| 0.3 * ((k as f64 + 1.0) * s).sin();
            let (i, j) = (k % side, k / side);
            Vector([(i as f64 + 0.5 + wobble(12.9898)) * step, (j as f64 + 0.5 + wobble(78.233)) * step])
        })
        .collect()
}

fn sums(hood: &Neighbourhood<f64, 2>, x: &[Vector<f64, 2>]) -> Vec<u64> {
    let (mut records, mut sums) = (Aligned::default(), Sums::default());
    hood.pack::<Cone<f64>>(x, &mut records, &[0.0, 1.0], &|i, rest| {
        rest[0] = 1.0 + i as f64;
        rest[1] = 0.0;
    });
    hood.sum(&Cone { support: hood.support() }, &records, &mut sums);
    (0..x.len()).map(|i| sums.get(i, 0).to_bits()).collect()
}

fn periodic() -> Periodic<f64, 2> {
    Periodic::new(Vector([0.0, 0.0]), [Some(1.0), Some(1.0)]).unwrap()
}

#[test]
fn every_search_gives_the_same_sums_and_so_does_every_skin() {
    let x = cloud(17);
    let build = |search: Box<dyn NeighbourSearch<f64, 2>>, skin, periodic| {
        let mut hood = Neighbourhood::new(search, 0.13).with_skin(skin).with_periodic(periodic);
        hood.rebuild(&x, 0);
        sums(&hood, &x)
    };
    for skin in [0.0, 0.02] {
        let oracle = build(Box::<BruteForce>::default(), skin, periodic());
        assert!(oracle.iter().all(|&bits| f64::from_bits(bits) > 0.0));
        assert_eq!(oracle, build(Box::<CellList<f64, 2>>::default(), skin, periodic()));
    }
    // Ghosts are sorted by cells as wide as support and skin, so only without them do bits agree.
    let oracle = build(Box::<BruteForce>::default(), 0.0, Periodic::none());
    assert_eq!(oracle, build(Box::<CellList<f64, 2>>::default(), 0.05, Periodic::none()));
    assert_eq!(oracle, build(Box::<CellList<f64, 2>>::default(), f64::NAN, Periodic::none()));
}

#[test]
fn a_chunk_hands_over_the_sums_that_are_kept() {
    let x = cloud(40);
    let chunk = Sums::<f64>::CHUNK;
    assert!(x.len() > chunk && !x.len().is_multiple_of(chunk));
    let mut hood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 0.06);
    hood.rebuild(&x, 0);
    let (mut records, mut sums) = (Aligned::default(), Sums::default());
    hood.pack::<Cone<f64>>(&x, &mut records, &[0.0, 1.0], &|i, rest| rest[..2].fill(1.0 + i as f64));
    let mut seen = vec![[0.0; 3]; x.len()];
    let cone = Cone { support: hood.support() };
    let keep = |sums: &mut crate::summation::ChunkSums<'_, f64>, part: &mut &mut [[f64; 3]]| {
        sums.all_mut(1)[0] = -1.0;
        for (l, seen) in part.iter_mut().enumerate() {
            *seen = [(sums.first + l) as f64, sums.all(0)[l], sums.all(1)[l]];
        }
    };
    hood.sum_and_then(&cone, &records, &mut sums, seen.chunks_mut(chunk), &keep);
    for (i, seen) in seen.iter().enumerate() {
        assert_eq!(*seen, [i as f64, sums.get(i, 0), sums.get(i, 1)], "particle {i}");
        assert_eq!(seen[2] == -1.0, i % chunk == 0, "particle {i}");
    }
    let bits = |sums: &Sums<f64>| (0..x.len()).map(|i| sums.get(i, 0).to_bits()).collect::<Vec<_>>();
    let mut again = Sums::default();
    hood.sum(&cone, &records, &mut again);
    assert_eq!(bits(&sums), bits(&again));
}

#[test]
fn the_sum_is_that_of_the_visited_neighbours() {
    let x = cloud(12);
    let mut hood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 0.2).with_periodic(periodic());
    hood.rebuild(&x, 0);
    for (i, bits) in sums(&hood, &x).into_iter().enumerate() {
        let (mut expected, mut near) = (0.0, 0);
        hood.for_each_neighbour(&x, i, |j, offset, r2| {
            assert!((offset.norm2() - r2).abs() < 1e-15 && r2 < 0.04);
            expected += (1.0 + j as f64) * (0.2 - r2.sqrt());
            near += 1;
        });
        assert!((f64::from_bits(bits) - expected).abs() < 1e-12 * expected);
        // The particle is near its own place too, also from another box.
        let mut found = 0;
        hood.for_each_near(&x, &(x[i] + Vector([3.0, -2.0])), |_, _, _| found += 1);
        assert_eq!(found, near + 1);
    }
}

#[test]
fn the_list_serves_until_two_may_have_met() {
    let mut x = cloud(10);
    let mut hood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 0.2);
    assert!(hood.is_stale(&x));
    hood.rebuild(&x, 0);
    assert!(!hood.is_stale(&x) && hood.is_stale(&x[1..]));
    // The skin is 0.02: one particle may walk that far, two towards each other half as far each.
    x[7][0] += 0.0199;
    assert!(!hood.is_stale(&x));
    x[8][0] -= 0.0002;
    assert!(hood.is_stale(&x));
    x[8][0] += 0.0002;
    // All together may walk as far as they like.
    let together: Vec<_> = x.iter().map(|x| *x + Vector([3.0, -1.0])).collect();
    assert!(!hood.is_stale(&together));
    x[7][0] = f64::NAN;
    assert!(hood.is_stale(&x));
}

#[test]
fn walls_see_no_walls_and_everybody_sees_walls() {
    let x = cloud(10);
    let walls = 20;
    let mut hood =
        Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 0.25).with_skin(0.0).with_periodic(periodic());
    hood.rebuild(&x, walls);
    let mut full = Neighbourhood::new(Box::<BruteForce>::default(), 0.25).with_periodic(periodic());
    full.rebuild(&x, 0);
    for i in 0..x.len() {
        let (mut seen, mut expected) = (Vec::new(), Vec::new());
        hood.for_each_neighbour(&x, i, |j, _, _| seen.push(j));
        full.for_each_neighbour(&x, i, |j, _, _| expected.push(j));
        if i < walls {
            expected.retain(|&j| j >= walls);
        }
        seen.sort_unstable();
        expected.sort_unstable();
        assert_eq!(seen, expected, "particle {i}");
    }
    let owners: Vec<bool> = hood.ghosts().iter().map(|g| (g.owner as usize) < walls).collect();
    assert!(owners.is_sorted_by(|a, b| a >= b));
}

#[test]
fn the_cell_order_is_a_permutation_that_keeps_walls_first() {
    let x = cloud(30);
    let hood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 0.1).with_periodic(periodic());
    let order = hood.cell_order(&x, 100);
    let mut sorted = order.clone();
    sorted[..100].sort_unstable();
    sorted[100..].sort_unstable();
    assert!(sorted.iter().copied().eq(0..900));
    // Sorting once is enough.
    let y: Vec<_> = order.iter().map(|&i| x[i as usize]).collect();
    assert!(hood.cell_order(&y, 100).into_iter().eq(0..900));
}

#[test]
fn an_empty_cloud_and_a_lost_particle_do_no_harm() {
    let mut hood = Neighbourhood::<f64, 2>::new(Box::<CellList<f64, 2>>::default(), 0.2);
    hood.rebuild(&[], 0);
    assert!(!hood.is_stale(&[]) && sums(&hood, &[]).is_empty());
    let mut x = cloud(5);
    x[3][1] = f64::INFINITY;
    hood.rebuild(&x, 0);
    let result = sums(&hood, &x);
    assert!((0..25).filter(|&i| i != 3).all(|i| f64::from_bits(result[i]).is_finite()));
}
