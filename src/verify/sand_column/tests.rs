//! Measures of shapes whose measures are known.

use super::*;
use crate::kernel::WendlandC2;
use crate::material::{Absent, Elasticity, Soil, Unyielding};
use crate::mixture::{Mixture, Phase};
use crate::output::Table;
use crate::time::Evolve;
use crate::verify::Curve;
use crate::{Real, SymTensor, Vector, setup};

const SPACING: f64 = 0.0025;

type Sand<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Absent>;

/// Soil at these places, among walls that no measure may see.
fn sand<T: Real, const D: usize>(places: &[Vector<T, D>], spacing: f64) -> Sand<T, D> {
    let elasticity = Elasticity::new(T::of(0.84e6), T::of(0.3)).unwrap();
    let mut soil = Phase::new(Soil::new(T::of(2650.0), elasticity, Unyielding).unwrap());
    let volume = T::of(spacing.powi(D as i32));
    let far = [Vector::of([5.0; D])];
    soil.add_wall(crate::mixture::Wall::dynamic(), &far, volume, |_| T::ZERO).unwrap();
    soil.add(places, volume, |_| T::ZERO).unwrap();
    Mixture::of_soil(WendlandC2::new(T::of(2.0 * spacing)).unwrap(), soil)
}

fn block<T: Real>() -> Sand<T, 2> {
    sand(&setup::fill([0.0, 0.0], [WIDTH, HEIGHT], SPACING), SPACING)
}

/// The column with its particles moved elsewhere.
fn moved<T: Real>(to: impl Fn([f64; 2]) -> [f64; 2]) -> Pile {
    let mut mixture = block::<T>();
    for x in mixture.soil_mut().positions_mut() {
        *x = Vector::of(to(x.as_f64()));
    }
    Pile::of(&mixture, Section::FLAT)
}

/// What is below a straight line from (0, 0.1) to (0.4, 0).
fn wedge<T: Real>(spacing: f64) -> Pile {
    let all = setup::fill::<T, 2>([0.0, 0.0], [0.4, 0.1], spacing);
    let below = all.into_iter().filter(|x| x[1].as_f64() < slope(x[0].as_f64())).collect::<Vec<_>>();
    Pile::of(&sand(&below, spacing), Section::FLAT)
}

fn slope(x: f64) -> f64 {
    0.1 - 0.25 * x
}

fn the_surface_is_found<T: Real>() {
    let level = Pile::of(&block::<T>(), Section::FLAT);
    assert!((level.spacing() - SPACING).abs() < 1e-9 && level.grains().len() == 3200);
    for x in [0.0, 0.0513, 0.1] {
        assert!((level.surface(x) - HEIGHT).abs() < 0.01 * SPACING, "{x} {}", level.surface(x));
    }
    assert_eq!(level.surface(0.3), 0.0);
    // The corner is rounded off.
    assert!((level.front() - WIDTH).abs() < 0.01 * SPACING, "{}", level.front());
    let ratio = level.volume_below_surface() / (WIDTH * HEIGHT);
    assert!((0.999..1.0).contains(&ratio), "{ratio}");
    assert!((level.volume() / (WIDTH * HEIGHT) - 1.0).abs() < 1e-6);
    let pile = wedge::<T>(SPACING);
    let line = Curve::new((0..38).map(|n| 0.01 * f64::from(n)).map(|x| (x, slope(x))).collect());
    let (rms, count) = pile.profile().distance(&line, 0.0);
    assert!(count == 38 && rms < 0.3 * SPACING, "{rms} {count}");
    let (high, low) = (pile.reach(0.05).unwrap(), pile.reach(0.02).unwrap());
    assert!((high - 0.2).abs() < 2.0 * SPACING && (low - 0.32).abs() < 2.0 * SPACING, "{high} {low}");
    assert!((pile.front() - 0.395).abs() < 2.0 * SPACING, "{}", pile.front());
    assert!((pile.volume_below_surface() / 0.02 - 1.0).abs() < 0.01, "{}", pile.volume_below_surface());
    assert_eq!(pile.reach(0.2), None);
}

#[test]
fn the_surface_of_a_block_and_of_a_wedge_is_found() {
    the_surface_is_found::<f32>();
    the_surface_is_found::<f64>();
}

#[test]
fn the_surface_of_a_wedge_converges() {
    let line = Curve::new((2..34).map(|n| 0.01 * f64::from(n)).map(|x| (x, slope(x))).collect());
    let error = |spacing: f64| wedge::<f64>(spacing).profile().distance(&line, 0.0).0;
    let (coarse, fine) = (error(SPACING), error(0.5 * SPACING));
    assert!(fine < 0.6 * coarse, "{fine} {coarse}");
}

fn a_lone_grain_is_not_of_the_heap<T: Real>() {
    // The last particle lies alone on the floor, half a metre away, the one before it on the surface.
    let mut mixture = block::<T>();
    let last = mixture.soil().len() - 1;
    mixture.soil_mut().positions_mut()[last] = Vector::of([0.5, 0.5 * SPACING]);
    mixture.soil_mut().positions_mut()[last - 30] = Vector::of([0.1, 0.3]);
    let pile = Pile::of(&mixture, Section::FLAT);
    assert!((pile.front() - WIDTH).abs() < SPACING, "{}", pile.front());
    assert!((pile.farthest() - 0.5 - 0.5 * SPACING).abs() < 1e-6, "{}", pile.farthest());
    assert!((pile.surface(0.1) - HEIGHT).abs() < 0.01 * SPACING, "{}", pile.surface(0.1));
    // Nor if their densities say that they have grown.
    let grown = pile.grains().iter().map(|grain| {
        let is_alone = grain.place[0] > 0.4 || grain.place[1] > 0.2;
        Grain { volume: if is_alone { 3.0 * grain.volume } else { grain.volume }, ..*grain }
    });
    let pile = Pile::new(Section::FLAT, SPACING, grown.collect());
    assert!((pile.front() - WIDTH).abs() < SPACING && pile.surface(0.1) < HEIGHT + SPACING);
}

#[test]
fn grains_that_lie_about_alone_are_not_of_the_heap() {
    a_lone_grain_is_not_of_the_heap::<f32>();
    a_lone_grain_is_not_of_the_heap::<f64>();
}

fn the_failure_line_is_found<T: Real>() {
    let start = Pile::of(&block::<T>(), Section::FLAT);
    // What is outside of a line at 33° slides along it, the farther the deeper it lies outside.
    let (sin, cos) = 33_f64.to_radians().sin_cos();
    let slid = |[x, y]: [f64; 2]| {
        let by = (((x - 0.18) * sin + y * cos) * 0.5 + MOVED).max(0.0);
        [x + by * cos, y - by * sin]
    };
    let line = FailureLine::between(&start, &moved::<T>(slid), MOVED);
    let (angle, foot) = line.straight().unwrap();
    assert!((angle - 33.0).abs() < 0.1 && (foot - 0.18).abs() < 0.1 * SPACING, "{angle} {foot}");
    assert!((line.foot().unwrap() - foot).abs() < SPACING, "{:?}", line.foot());
    assert_eq!(line.points().len(), 40);
    // Turned about its corner at the wall it has moved beyond a circle.
    let angle = 0.02_f64;
    let turned = |[x, y]: [f64; 2]| {
        let (sin, cos) = angle.sin_cos();
        [x * cos - y * sin, x * sin + y * cos]
    };
    let radius = 0.5 * MOVED / (0.5 * angle).sin();
    let line = FailureLine::between(&start, &moved::<T>(turned), MOVED);
    assert!(line.points().len() > 30);
    for (x, y) in line.points() {
        assert!((x.hypot(*y) - radius).abs() < 1e-2 * SPACING, "{x} {y}");
    }
    assert_eq!(FailureLine::between(&start, &start, MOVED).straight(), None);
}

#[test]
fn the_failure_line_of_a_slide_and_of_a_turned_block_is_found() {
    the_failure_line_is_found::<f32>();
    the_failure_line_is_found::<f64>();
}

fn pressure_and_rest_are_measured<T: Real>() {
    let mut mixture = block::<T>();
    let deep = |x: &Vector<T, 2>| (T::of(HEIGHT) - x[1]).max(T::ZERO);
    mixture.soil_mut().set_stress(|x| SymTensor::isotropic(deep(x) * T::of(-26e3)));
    mixture.soil_mut().set_velocity(|_| Vector::of([0.3, 0.4]));
    mixture.evaluate().unwrap();
    let pile = Pile::of(&mixture, Section::FLAT);
    assert!((pile.rms_velocity() - 0.5).abs() < 1e-6);
    assert!((pile.largest_pressure() / (26e3 * (HEIGHT - 0.5 * SPACING)) - 1.0).abs() < 1e-5);
    let still = Pile::of(&block::<T>(), Section::FLAT);
    assert_eq!((still.rms_velocity(), still.largest_pressure()), (0.0, 0.0));
}

#[test]
fn pressure_and_rest_of_a_block_are_measured() {
    pressure_and_rest_are_measured::<f32>();
    pressure_and_rest_are_measured::<f64>();
}

#[test]
fn in_three_dimensions_a_channel_and_a_cylinder_have_a_section() {
    let spacing = 0.01;
    let channel = setup::fill::<f64, 3>([0.0; 3], [WIDTH, HEIGHT, 0.05], spacing);
    let pile = Pile::of(&sand(&channel, spacing), Section::Plane { width: 0.05 });
    assert!((pile.surface(0.1) - HEIGHT).abs() < 0.01 * spacing, "{}", pile.surface(0.1));
    assert!((pile.front() - WIDTH).abs() < 0.05 * spacing, "{}", pile.front());
    assert!((pile.volume_below_surface() / 1e-3 - 1.0).abs() < 0.01);
    let all = setup::fill::<f64, 3>([-0.2, 0.0, -0.2], [0.2, HEIGHT, 0.2], spacing);
    let round: Vec<_> = all.into_iter().filter(|x| x[0].hypot(x[2]) < WIDTH).collect();
    let section = Section::Round { axis: [0.0; 2], angle: core::f64::consts::TAU };
    let pile = Pile::of(&sand(&round, spacing), section);
    for x in [0.05, 0.1, 0.15] {
        assert!((pile.surface(x) - HEIGHT).abs() < 0.2 * spacing, "{x} {}", pile.surface(x));
    }
    assert!((pile.front() - WIDTH).abs() < 0.5 * spacing, "{}", pile.front());
    let ratio = pile.volume_below_surface() / pile.volume();
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

#[test]
fn no_soil_has_no_shape() {
    let pile = Pile::new(Section::FLAT, 0.0, Vec::new());
    assert_eq!((pile.surface(0.1), pile.front(), pile.volume_below_surface()), (0.0, 0.0, 0.0));
    assert!(pile.profile().points().is_empty() && pile.reach(0.01).is_none());
}

fn published(text: &str) -> Vec<(f64, f64)> {
    let table = Table::parse(text).unwrap();
    table.column("x_m").unwrap().into_iter().zip(table.column("y_m").unwrap()).collect()
}

#[test]
fn the_published_failure_line_is_straight() {
    let text = include_str!("../../../verification/data/bui_2008_failure_line.csv");
    let (angle, foot) = FailureLine::new(published(text)).straight().unwrap();
    assert!((angle - 32.9).abs() < 0.05 && (foot - 0.179).abs() < 5e-4, "{angle} {foot}");
}

#[test]
fn the_laws_are_those_of_the_data() {
    let text = include_str!("../../../verification/data/column_collapse_scaling_laws.csv");
    let table = Table::parse(text).unwrap();
    let [from, to, factor, exponent] =
        ["a_min", "a_max", "coef", "exponent"].map(|name| table.column(name).unwrap());
    let quantities = table.text("quantity").unwrap();
    let sources = table.text("source").unwrap();
    let listed: Vec<usize> = (0..table.rows()).filter(|n| quantities[*n] == "dL").collect();
    assert_eq!(listed.len(), RUN_OUT.len());
    for (law, n) in RUN_OUT.iter().zip(listed) {
        assert_eq!((law.range, law.factor, law.exponent), ((from[n], to[n]), factor[n], exponent[n]));
        let name = sources[n].split(' ').next().unwrap();
        assert!(law.source.starts_with(name) || (name == "LSP" && law.source.starts_with("Lagrée")));
    }
    assert_eq!(RUN_OUT[0].at(0.5), Some(0.6));
    assert_eq!((RUN_OUT[0].at(2.0), RUN_OUT[0].at(0.0)), (None, None));
    assert!((run_out(0.42, WIDTH) - 1.1).abs() < 1e-12);
}
