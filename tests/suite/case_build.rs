//! A case becomes the particles it describes.

use alluvium::case::{BuildError, Case, Side};
use alluvium::kernel::WendlandC2;
use alluvium::mixture::{Slip, WallKind};
use alluvium::time::{LeapFrog, Limit, VelocityVerlet};

const CHANNEL: &str = r#"
name = "channel"
dimension = 3
precision = "f32"
end_time_s = 0.01
gravity_m_per_s2 = [0.0, -9.81, 0.0]
periodic.axes = ["z"]
[particles]
spacing_m = 0.01
[water]
sound_speed_m_per_s = 20.0
[[water.block]]
low_m = [0.0, 0.0, 0.0]
high_m = [0.05, 0.1, 0.06]
velocity_m_per_s = [0.5, 0.0, 0.0]
[tank]
low_m = [0.0, 0.0, 0.0]
high_m = [0.2, 0.15, 0.06]
open = ["+y"]
slip = "no-slip"
[[tank.moving]]
side = "+x"
velocity_m_per_s = [-0.1, 0.0, 0.0]
"#;

fn case(text: &str) -> Case {
    match Case::parse("test.toml", text) {
        Ok((case, _)) => case,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn particles_stand_where_the_case_says() {
    let case = case(CHANNEL);
    let kernel = WendlandC2::<f32, 3>::new(case.smoothing_length() as f32).unwrap();
    let mixture = case.mixture::<f32, 3, _>(kernel).unwrap();
    let water = mixture.water();
    assert_eq!(case.wall_sides(), [Side::LowX, Side::HighX, Side::LowY]);
    // Three layers, no walls across z, corners with the side that rests.
    let count = |body: u16| water.bodies().iter().filter(|b| **b == body).count();
    assert_eq!([0, 1, 2].map(count), [3 * 18 * 6, 3 * 15 * 6, (20 + 3) * 3 * 6]);
    assert_eq!(water.len() - water.wall_particles(), 5 * 10 * 6);
    for wall in water.walls() {
        assert_eq!(wall.kind(), WallKind::Extrapolated { slip: Slip::NoSlip, suction: false });
    }
    assert_eq!(water.walls().iter().map(|wall| wall.moves()).collect::<Vec<_>>(), [false, true, false]);
    for i in 0..water.len() {
        let (x, p) = (water.positions()[i], water.pressures()[i]);
        if i >= water.wall_particles() {
            assert!((p - 9810.0 * (0.1 - x[1])).abs() < 0.01, "{p} at {:?}", x.0);
            assert_eq!(water.velocities()[i][0], 0.5);
        } else if x[0] > 0.1 {
            assert_eq!(p, 0.0, "dry wall at {:?}", x.0);
        } else if x[1] < 0.0 && x[0] < 0.05 {
            assert!(p > 981.0, "floor under water at {:?}", x.0);
        }
    }
}

#[test]
fn a_wall_that_moves_moves() {
    let case = case(CHANNEL);
    let kernel = WendlandC2::<f32, 3>::new(case.smoothing_length() as f32).unwrap();
    let mut run = case.simulation(kernel, LeapFrog::new()).unwrap();
    let _ = run.run_until(case.end_time, |_| core::ops::ControlFlow::<()>::Continue(())).unwrap();
    let water = run.mixture().water();
    let places = (0..water.wall_particles()).filter(|i| water.bodies()[*i] == 1);
    let nearest = places.map(|i| water.positions()[i][0]).fold(f32::INFINITY, f32::min);
    assert!((nearest - (0.205 - 0.1 * 0.01)).abs() < 1e-6, "{nearest}");
}

#[test]
fn a_case_of_another_dimension_is_refused() {
    let case = case(CHANNEL);
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
    let refused = case.mixture::<f64, 2, _>(kernel).unwrap_err();
    assert_eq!(refused, BuildError::Dimension { case: 3, asked: 2 });
}

#[test]
fn a_fixed_step_leaves_no_crumb_at_the_end() {
    let text = "name = \"drop\"\nend_time_s = 0.001\nwater.sound_speed_m_per_s = 20.0\n\
                water.block = [{ low_m = [0.0, 0.0], high_m = [0.1, 0.1] }]\n\
                particles.spacing_m = 0.01\ntime.time_step_s = 1e-4\n";
    let case = case(text);
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
    let mut run = case.simulation(kernel, VelocityVerlet::new()).unwrap();
    // Ten times 1e-4 is not 1e-3 in binary.
    let _ = run.run_until(case.end_time, |_| core::ops::ControlFlow::<()>::Continue(())).unwrap();
    assert_eq!((run.steps(), run.last_step().limit), (10, Limit::Fixed));
}
