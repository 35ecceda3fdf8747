//! Searches from outside the library: a right one, a careless one and a wrong one.

use super::{Cloud, cloud, difference, periodic};
use alluvium::neighbours::{NeighbourSearch, Periodic};
use alluvium::{Real, Vector};
use std::ops::Range;

/// A search of a user's own: points by their first coordinate, and a careless one that proposes
/// everything between the first and the last hit, then the hits again.
#[derive(Debug, Default)]
struct Sweep {
    order: Vec<(f64, u32)>,
    radius: f64,
    /// Of the radius, how much it looks at.
    part: f64,
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for Sweep {
    fn name(&self) -> &'static str {
        "sweep"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.order = (0..).zip(points).map(|(i, x)| (x[0].as_f64(), i)).collect();
        self.order.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.radius = radius.as_f64() * self.part;
    }
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        let x = place[0].as_f64();
        let from = self.order.partition_point(|&(other, _)| other < x - self.radius);
        let near = self.order[from..].iter().take_while(|&&(other, _)| other <= x + self.radius);
        let hits: Vec<u32> = near.map(|&(_, i)| i).collect();
        if let (Some(&first), Some(&last)) = (hits.iter().min(), hits.iter().max()) {
            ranges.push(first..last + 1);
        }
        ranges.extend(hits.iter().rev().map(|&i| i..i + 1));
    }
}

#[test]
fn a_search_of_ones_own_plugs_in() {
    for kind in [Cloud::Lattice, Cloud::Random, Cloud::Shuffled] {
        let (points, dx) = cloud::<f64, 2>(kind, 300, 11);
        let mut own = Sweep { part: 1.0, ..Sweep::default() };
        assert_eq!(difference(&mut own, &points, 2.6 * dx, &periodic(1)), None);
    }
}

/// The comparison above can fail: it sees a search that looks 1 % too near.
#[test]
fn a_search_that_looks_too_near_is_caught() {
    // Points on a line, in no order: no neighbour is proposed by chance as one between two others.
    let points: Vec<Vector<f64, 2>> =
        (0..400).map(|i| Vector::of([f64::from(i * 173 % 400) * 1e-2, 0.0])).collect();
    let radius = 0.2515; // between the 25th and the 26th neighbour, the 25th beyond 99 %
    let mut short = Hits { part: 0.99, points: Vec::new(), radius: 0.0 };
    let wrong = difference(&mut short, &points, radius, &Periodic::none());
    assert!(wrong.is_some_and(|text| text.starts_with("hits: point 0 ")));
    let mut right = Hits { part: 1.0, points: Vec::new(), radius: 0.0 };
    assert_eq!(difference(&mut right, &points, radius, &Periodic::none()), None);
}

/// Proposes the points within a part of the radius, and no other.
#[derive(Debug)]
struct Hits {
    points: Vec<Vector<f64, 2>>,
    radius: f64,
    part: f64,
}

impl NeighbourSearch<f64, 2> for Hits {
    fn name(&self) -> &'static str {
        "hits"
    }
    fn rebuild(&mut self, points: &[Vector<f64, 2>], radius: f64) {
        self.points = points.to_vec();
        self.radius = radius * self.part;
    }
    fn candidates(&self, place: &Vector<f64, 2>, ranges: &mut Vec<Range<u32>>) {
        let near = (0..).zip(&self.points).filter(|(_, x)| (*place - **x).norm() <= self.radius);
        ranges.extend(near.map(|(i, _)| i..i + 1));
    }
}
