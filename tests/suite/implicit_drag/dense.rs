//! The iteration against a dense solution of the whole matrix.

use super::{Both, cloud, darcy, weight};
use alluvium::Vector;
use alluvium::material::{DragLaw, NoDrag};
use alluvium::mixture::DragScheme;
use alluvium::time::{Evolve, Moment};

/// Effective accelerations of a backward Euler step, soil first, by a dense Cholesky factor of the whole matrix;
/// with `one_sided`, soil feels no drag.
fn dense(
    mixture: &Both<f64>,
    without: &Both<f64>,
    conductivity: f64,
    dt: f64,
    one_sided: bool,
) -> Vec<[f64; 2]> {
    let (soil, water) = (mixture.soil(), mixture.water());
    let (n, all) = (soil.len(), soil.len() + water.len());
    let walls = soil.wall_particles();
    let joined = |x: &[Vector<f64, 2>], y: &[Vector<f64, 2>]| [x, y].concat();
    let velocity = joined(soil.velocities(), water.velocities());
    let other = joined(without.soil().accelerations(), without.water().accelerations());
    let masses = [soil.masses(), water.masses()].concat();
    let law = darcy::<f64>(conductivity);
    let mut matrix = vec![vec![0.0; all]; all];
    for i in 0..n {
        for a in 0..water.len() {
            let strength = law.coefficient(water.volume_fraction(a), water.true_density(a), 0.0);
            let k = soil.volume(i) * water.volume(a) * strength * weight(mixture, i, a);
            matrix[i][i] += if one_sided { 0.0 } else { dt * k };
            matrix[n + a][n + a] += dt * k;
            matrix[i][n + a] -= if one_sided { 0.0 } else { dt * k };
            matrix[n + a][i] -= dt * k;
        }
    }
    let mut sides: Vec<[f64; 2]> = (0..all)
        .map(|p| {
            let drag = |c: usize| (0..all).map(|q| matrix[p][q] * velocity[q][c]).sum::<f64>() / dt;
            core::array::from_fn(|c| masses[p] * other[p][c] - drag(c))
        })
        .collect();
    for p in 0..all {
        matrix[p][p] += masses[p];
        for q in 0..all {
            if p < walls || q < walls {
                matrix[p][q] = f64::from(u8::from(p == q));
            }
        }
        if p < walls {
            sides[p] = [0.0; 2];
        }
    }
    solve(matrix, sides)
}

/// The solution of a symmetric positive definite system, by its factor L Lᵀ in the lower triangle.
fn solve(mut matrix: Vec<Vec<f64>>, mut sides: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let all = sides.len();
    // A matrix that is not positive definite has no root.
    for p in 0..all {
        for q in 0..=p {
            let inner: f64 = (0..q).map(|r| matrix[p][r] * matrix[q][r]).sum();
            let rest = matrix[p][q] - inner;
            matrix[p][q] = if p == q { rest.sqrt() } else { rest / matrix[q][q] };
        }
        assert!(matrix[p][p] > 0.0);
    }
    for c in 0..2 {
        for p in 0..all {
            let inner: f64 = (0..p).map(|r| matrix[p][r] * sides[r][c]).sum();
            sides[p][c] = (sides[p][c] - inner) / matrix[p][p];
        }
        for p in (0..all).rev() {
            let inner: f64 = (p + 1..all).map(|r| matrix[r][p] * sides[r][c]).sum();
            sides[p][c] = (sides[p][c] - inner) / matrix[p][p];
        }
    }
    sides
}

/// Largest difference of the velocities after the step from the dense solution, free particles only, and what
/// the step lacks of momentum, held particles' included and relative.
fn against_dense(conductivity: f64, one_sided: bool) -> [f64; 2] {
    let dt = 5e-4;
    let mut mixture = cloud(conductivity, DragScheme::BackwardEuler);
    let mut without = cloud(conductivity, DragScheme::Explicit).with_drag(NoDrag);
    without.evaluate().unwrap();
    mixture.evaluate().unwrap();
    let expected = dense(&mixture, &without, conductivity, dt, one_sided);
    mixture.complete(Moment::Now, dt).unwrap();
    let joined = |of: &Both<f64>| [of.soil().accelerations(), of.water().accelerations()].concat();
    let (found, other) = (joined(&mixture), joined(&without));
    let masses = [mixture.soil().masses(), mixture.water().masses()].concat();
    let walls = mixture.soil().wall_particles();
    let free = walls..found.len();
    let error = free.map(|p| (found[p] - Vector(expected[p])).norm()).fold(0.0, f64::max) * dt;
    let mut momentum = Vector([0.0; 2]);
    let mut size = 0.0;
    for ((m, a), b) in masses.iter().zip(&found).zip(&other) {
        momentum += (*a - *b) * *m;
        size += m * (a.norm() + b.norm());
    }
    [error, momentum.norm() / size]
}

#[test]
fn the_iteration_finds_the_dense_solution() {
    for conductivity in [1e-1, 1e-3, 1e-5, 1e-7] {
        let [error, momentum] = against_dense(conductivity, false);
        assert!(error < 1e-9 && momentum < 1e-13, "k = {conductivity:e}: {error:e}, momentum {momentum:e}");
    }
}

#[test]
fn drag_on_one_side_only_is_noticed() {
    assert!(against_dense(1e-3, true)[0] > 1e-2);
}
