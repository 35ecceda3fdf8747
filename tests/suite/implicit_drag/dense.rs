//! The iteration against a dense solution of the whole matrix.

use super::{Both, H, cloud, darcy, nearest, weight};
use alluvium::Vector;
use alluvium::material::{DragLaw, NoDrag};
use alluvium::mixture::DragScheme;
use alluvium::time::{Evolve, Moment};

/// How soil and water drag each other.
#[derive(Clone, Copy, PartialEq)]
enum Drag {
    AlongTheSlip,
    AlongTheLine,
    /// Soil feels none.
    OneSided,
}

/// Effective accelerations of a backward Euler step, soil first, by a dense Cholesky factor of the whole matrix, with
/// two unknowns for each particle.
fn dense(
    mixture: &Both<f64>,
    without: &Both<f64>,
    conductivity: f64,
    dt: f64,
    drag: Drag,
) -> Vec<Vector<f64, 2>> {
    let (soil, water) = (mixture.soil(), mixture.water());
    let (n, all) = (soil.len(), 2 * (soil.len() + water.len()));
    let walls = 2 * soil.wall_particles();
    let joined = |x: &[Vector<f64, 2>], y: &[Vector<f64, 2>]| -> Vec<f64> {
        [x, y].concat().iter().flat_map(|v| v.0).collect()
    };
    let velocity = joined(soil.velocities(), water.velocities());
    let other = joined(without.soil().accelerations(), without.water().accelerations());
    let masses: Vec<f64> = [soil.masses(), water.masses()].concat().iter().flat_map(|&m| [m, m]).collect();
    let law = darcy::<f64>(conductivity);
    let mut matrix = vec![vec![0.0; all]; all];
    for i in 0..n {
        for a in 0..water.len() {
            let strength = law.coefficient(water.volume_fraction(a), water.true_density(a), 0.0);
            let k = soil.volume(i) * water.volume(a) * strength * weight(mixture, i, a);
            let line = nearest(mixture, i, a);
            for (c, d) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let part = match drag {
                    Drag::AlongTheLine => 2.0 * line[c] * line[d] / (line.norm2() + 1e-6 * H * H),
                    _ => f64::from(u8::from(c == d)),
                };
                let (of_soil, of_water) = (2 * i, 2 * (n + a));
                matrix[of_water + c][of_water + d] += dt * k * part;
                matrix[of_water + c][of_soil + d] -= dt * k * part;
                if drag != Drag::OneSided {
                    matrix[of_soil + c][of_soil + d] += dt * k * part;
                    matrix[of_soil + c][of_water + d] -= dt * k * part;
                }
            }
        }
    }
    let mut sides: Vec<f64> = (0..all)
        .map(|p| {
            let drag = (0..all).map(|q| matrix[p][q] * velocity[q]).sum::<f64>() / dt;
            masses[p] * other[p] - drag
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
            sides[p] = 0.0;
        }
    }
    solve(matrix, sides).chunks(2).map(|x| Vector([x[0], x[1]])).collect()
}

/// The solution of a symmetric positive definite system, by its factor L Lᵀ in the lower triangle.
fn solve(mut matrix: Vec<Vec<f64>>, mut sides: Vec<f64>) -> Vec<f64> {
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
    for p in 0..all {
        let inner: f64 = (0..p).map(|r| matrix[p][r] * sides[r]).sum();
        sides[p] = (sides[p] - inner) / matrix[p][p];
    }
    for p in (0..all).rev() {
        let inner: f64 = (p + 1..all).map(|r| matrix[r][p] * sides[r]).sum();
        sides[p] = (sides[p] - inner) / matrix[p][p];
    }
    sides
}

/// Largest difference of the velocities after the step from the dense solution, free particles only, and what
/// the step lacks of momentum, held particles' included and relative.
fn against_dense(conductivity: f64, drag: Drag) -> [f64; 2] {
    let dt = 5e-4;
    let mixture = cloud(conductivity, DragScheme::BackwardEuler);
    let mut mixture = if drag == Drag::AlongTheLine { mixture.with_projected_drag() } else { mixture };
    let mut without = cloud(conductivity, DragScheme::Explicit).with_drag(NoDrag);
    without.evaluate().unwrap();
    mixture.evaluate().unwrap();
    let expected = dense(&mixture, &without, conductivity, dt, drag);
    mixture.complete(Moment::Now, dt).unwrap();
    let joined = |of: &Both<f64>| [of.soil().accelerations(), of.water().accelerations()].concat();
    let (found, other) = (joined(&mixture), joined(&without));
    let masses = [mixture.soil().masses(), mixture.water().masses()].concat();
    let walls = mixture.soil().wall_particles();
    let free = walls..found.len();
    let error = free.map(|p| (found[p] - expected[p]).norm()).fold(0.0, f64::max) * dt;
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
    for drag in [Drag::AlongTheSlip, Drag::AlongTheLine] {
        for conductivity in [1e-1, 1e-3, 1e-5, 1e-7] {
            let [error, momentum] = against_dense(conductivity, drag);
            assert!(
                error < 1e-9 && momentum < 1e-13,
                "k = {conductivity:e}: {error:e}, momentum {momentum:e}"
            );
        }
    }
}

#[test]
fn drag_on_one_side_only_is_noticed() {
    assert!(against_dense(1e-3, Drag::OneSided)[0] > 1e-2);
}
