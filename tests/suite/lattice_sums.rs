//! Kernel and neighbour search together: sums over a regular lattice, known exactly.

use crate::kernels::tolerance;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::neighbours::{CellList, Pairs, Periodic};
use alluvium::{Real, Vector};
use approx::assert_abs_diff_eq;

/// One row of the table: the sums over a lattice of spacing one, at a point of it.
struct Row {
    ratio: f64,
    neighbours: usize,
    sums: [f64; 3],
}

fn table(dimension: usize) -> Vec<Row> {
    let text = include_str!("../data/kernel_lattice_sums.csv");
    let numbers = |line: &str| line.split(',').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
    let rows = text.lines().filter(|line| !line.starts_with(['#', 'd'])).map(numbers);
    rows.filter(|row| row[0] == dimension as f64)
        .map(|row| Row { ratio: row[1], neighbours: row[2] as usize, sums: [row[3], row[4], row[5]] })
        .collect()
}

#[test]
fn the_sums_over_a_lattice_are_the_tabulated_ones() {
    fn check<T: Real, const D: usize>() {
        let rows = table(D);
        assert_eq!(rows.len(), 9);
        for row in rows {
            let half = (2.0 * row.ratio).ceil(); // the support, on either side of the middle
            let side = 2 * half as usize + 1;
            let points: Vec<Vector<T, D>> = (0..side.pow(D as u32))
                .map(|n| Vector::of(std::array::from_fn(|k| (n / side.pow(k as u32) % side) as f64 - half)))
                .collect();
            let middle = points.len() / 2;
            let kernel = WendlandC2::<T, D>::new(T::of(row.ratio)).unwrap();
            let pairs = Pairs::find(&mut CellList::default(), &points, kernel.support(), &Periodic::none());
            assert_eq!(pairs.of(middle).len() + 1, row.neighbours, "{D}D, h = {} dx", row.ratio);
            let (mut sums, h2) = ([-1.0, 1.0, 0.0], row.ratio * row.ratio);
            for j in pairs.of(middle).iter().map(|&j| j as usize).chain([middle]) {
                let (r2, x2) = (points[j].norm2(), points[j][0].as_f64().powi(2));
                let (w, f) = (kernel.value(r2).as_f64(), kernel.slope(r2).as_f64());
                sums = [sums[0] + w, sums[1] + f * x2, sums[2] + w * x2 / h2];
            }
            for (found, exact) in sums.into_iter().zip(row.sums) {
                assert_abs_diff_eq!(found, exact, epsilon = tolerance::<T>(1e-12, 2e-6));
            }
        }
    }
    check::<f64, 1>();
    check::<f64, 2>();
    check::<f64, 3>();
    check::<f32, 2>();
    check::<f32, 3>();
}
